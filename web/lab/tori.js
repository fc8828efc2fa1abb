// Tori that turn, drawn with WebGL2: the sharp picture, and for each pixel its depth and its distance. As the scene "wgld" of
// the program: eleven tori in even steps of 1/depth from 2.5 to 29 m, lit in the vertices, with a pattern; lamps if wanted.

export const VIEW = { width: 640, height: 360, half_width: 0.36, far_m: 60 };
const AROUND = 48, TUBE = 24, COUNT = 11;
const COLOURS = [[0.9, 0.25, 0.16], [0.92, 0.7, 0.18], [0.22, 0.66, 0.3], [0.16, 0.5, 0.85], [0.62, 0.26, 0.72]];

const VERTEX = `
layout(location = 0) in vec2 around_tube;   // angles
layout(location = 1) in vec4 place_size;    // of an instance: x, y, z, radius of the ring
layout(location = 2) in vec4 axis_kind;
layout(location = 3) in vec3 paint;
uniform vec2 half_size;
uniform float far;
out vec3 lit, shine, at_place;
out vec2 uv;
flat out float kind;
const vec3 kLight = normalize(vec3(-0.5, 0.7, -0.6));
void main() {
  vec3 axis = normalize(axis_kind.xyz), across = normalize(cross(axis, vec3(0.3, 0.2, 1))), other = cross(axis, across);
  vec3 ring = cos(around_tube.x) * across + sin(around_tube.x) * other;
  vec3 normal = cos(around_tube.y) * ring + sin(around_tube.y) * axis;
  vec3 point = place_size.xyz + place_size.w * (ring + 0.4 * normal);
  float diffuse = clamp(dot(normal, kLight), 0.1, 1.0);
  float specular = pow(clamp(dot(normal, normalize(kLight - normalize(point))), 0.0, 1.0), 50.0);
  lit = paint * diffuse, shine = vec3(specular) + paint * vec3(0.08, 0.08, 0.09);
  at_place = point, uv = around_tube / 6.2831853, kind = axis_kind.w;
  // Pictures have their top row first.
  gl_Position = vec4(point.x / half_size.x, -point.y / half_size.y, (2.0 * point.z / far - 1.0) * point.z, point.z);
}`;
const FRAGMENT = `
in vec3 lit, shine, at_place;
in vec2 uv;
flat in float kind;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 depth;
float soft(float t) { float w = max(fwidth(t), 0.02); return clamp(0.5 + (abs(fract(t) * 2.0 - 1.0) - 0.5) / w, 0.0, 1.0); }
void main() {
  float a = soft(10.0 * uv.x), b = soft(4.0 * uv.y);
  float t = kind < 0.5 ? a * (1.0 - b) + b * (1.0 - a) : soft(14.0 * uv.x + 2.0 * uv.y);
  colour = vec4(mix(vec3(0.25, 0.25, 0.28), vec3(1, 0.98, 0.94), t) * lit + shine, 1);
  depth = vec4(at_place.z, length(at_place), 0, 1);
}`;
const SKY = `
uniform vec2 size, half_size;
uniform float far;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 depth;
void main() {
  vec2 place = (gl_FragCoord.xy / size * 2.0 - 1.0) * half_size;
  vec3 way = vec3(place.x, -place.y, 1);
  colour = vec4(mix(vec3(0.02, 0.03, 0.05), vec3(0.10, 0.12, 0.18), 0.5 + 0.5 * normalize(way).y), 1);
  depth = vec4(0.999 * far, 0.999 * far * length(way), 0, 1);
}`;
const LAMP_VERTEX = `
layout(location = 0) in vec4 lamp;  // x, y, z, which
uniform vec2 half_size;
uniform float far;
out vec3 light, at_place;
void main() {
  gl_Position = vec4(lamp.x / half_size.x, -lamp.y / half_size.y, (2.0 * lamp.z / far - 1.0) * lamp.z, lamp.z);
  gl_PointSize = 2.0;
  int i = int(lamp.w) % 4;
  light = 36.0 * (i == 0 ? vec3(1, 0.75, 0.4) : i == 1 ? vec3(0.5, 0.75, 1) : i == 2 ? vec3(1, 0.45, 0.5) : vec3(0.6, 1, 0.6));
  at_place = lamp.xyz;
}`;
const LAMP = `
in vec3 light, at_place;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 depth;
void main() { colour = vec4(light, 1), depth = vec4(at_place.z, length(at_place), 0, 1); }`;

/** A number from 0 to 1 that is always the same for i. */
const scattered = (i, of) => Math.abs((Math.sin(i * 12.9898 + of * 78.233) * 43758.5453) % 1);

function meshOf() {
  const points = [], order = [];
  for (let i = 0; i <= AROUND; i++) for (let j = 0; j <= TUBE; j++) points.push((2 * Math.PI * i) / AROUND, (2 * Math.PI * j) / TUBE);
  for (let i = 0; i < AROUND; i++)
    for (let j = 0; j < TUBE; j++) {
      const a = i * (TUBE + 1) + j, b = a + TUBE + 1;
      order.push(a, b, a + 1, a + 1, b, b + 1);
    }
  return { points: new Float32Array(points), order: new Uint16Array(order) };
}

function toriAt(turns) {
  const words = [];
  for (let i = 0; i < COUNT; i++) {
    const z = 1 / (1 / 2.5 + (i / (COUNT - 1)) * (1 / 29 - 1 / 2.5)), turn = 2.4 * i, out = i === 0 ? 0.2 : 0.21 * Math.sqrt(1 - 0.06 * i);
    const spin = 2 * Math.PI * (turns + scattered(i, 1)), size = 0.13 * z ** 0.72;
    words.push(out * 1.25 * Math.cos(turn) * z, out * 0.72 * Math.sin(turn) * z, z, size, Math.cos(spin), 0.5, Math.sin(spin), i % 2, ...COLOURS[i % 5]);
  }
  return new Float32Array(words);
}

function lampsAt(turns) {
  const words = [];
  for (let i = 0; i < 72; i++) {
    const z = i % 6 === 0 ? 2 + 1.2 * scattered(i, 2) : 20 + 30 * scattered(i, 2), angle = 2 * Math.PI * (scattered(i, 3) + 0.1 * turns), out = (i % 6 === 0 ? 0.12 + 0.2 * scattered(i, 4) : 0.38 * Math.sqrt(scattered(i, 4))) * z;
    words.push(out * Math.cos(angle), 0.55 * out * Math.sin(angle), z, i);
  }
  return new Float32Array(words);
}

export class Tori {
  constructor(kit) {
    const { gl } = kit, { points, order } = meshOf();
    this.kit = kit;
    this.programs = { tori: kit.program(FRAGMENT, { vertex: VERTEX }), sky: kit.program(SKY), lamps: kit.program(LAMP, { vertex: LAMP_VERTEX }) };
    this.indices = order.length;
    this.buffers = Object.fromEntries(["points", "order", "each", "lamps"].map((name) => [name, gl.createBuffer()]));
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.points);
    gl.bufferData(gl.ARRAY_BUFFER, points, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.order);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, order, gl.STATIC_DRAW);
    this.depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, VIEW.width, VIEW.height);
  }

  /** @returns {{colour: object, depth: object}} targets: light; metres along the axis, metres along the ray */
  draw(turns, { lamps = false } = {}) {
    const { kit } = this, { gl } = kit, { width, height, half_width, far_m } = VIEW, half_size = [half_width, (half_width * height) / width];
    const targets = [kit.target("sharp", width, height), kit.target("depth", width, height)], inputs = { half_size, far: far_m, size: [width, height] };
    this.#off();
    gl.disable(gl.BLEND);
    kit.draw(this.programs.sky, targets, inputs, undefined, this.depth);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    this.#attribute(0, this.buffers.points, 2, 0, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.each);
    gl.bufferData(gl.ARRAY_BUFFER, toriAt(turns), gl.STREAM_DRAW);
    [4, 4, 3].forEach((count, i) => this.#attribute(i + 1, this.buffers.each, count, 44, 16 * i, 1));
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.buffers.order);
    kit.draw(this.programs.tori, targets, inputs, () => gl.drawElementsInstanced(gl.TRIANGLES, this.indices, gl.UNSIGNED_SHORT, 0, COUNT), this.depth);
    if (lamps) {
      this.#off();
      const words = lampsAt(turns);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.lamps);
      gl.bufferData(gl.ARRAY_BUFFER, words, gl.STREAM_DRAW);
      this.#attribute(0, this.buffers.lamps, 4, 0, 0, 0);
      kit.draw(this.programs.lamps, targets, inputs, () => gl.drawArrays(gl.POINTS, 0, words.length / 4), this.depth);
    }
    gl.disable(gl.DEPTH_TEST);
    this.#off();
    return { colour: targets[0], depth: targets[1] };
  }

  #attribute(place, buffer, count, stride, offset, divisor) {
    const { gl } = this.kit;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, count, gl.FLOAT, false, stride, offset);
    gl.vertexAttribDivisor(place, divisor);
  }

  #off() {
    for (let i = 0; i < 4; i++) this.kit.gl.disableVertexAttribArray(i);
  }
}
