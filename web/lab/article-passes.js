// The passes of three articles on depth of field, as docs/explain/published.md describes them. Each returns its buffers by name.
import { BILINEAR } from "./gl-kit.js";

/** wgld.org: one sharp picture and two Gaussian blurs, mixed by depth. */
export class Wgld {
  constructor(kit) {
    this.kit = kit;
    this.index = kit.program(`
uniform sampler2D depth;
uniform float offset, range;
out vec4 made;
void main() {
  float x = clamp(texelFetch(depth, ivec2(gl_FragCoord.xy), 0).y / range + offset, 0.0, 1.0);
  made = vec4(vec3(x < 0.4 ? 2.5 * x : x > 0.6 ? 2.5 * (1.0 - x) : 1.0), 1);
}`);
    this.blur = kit.program(`
uniform sampler2D image;
uniform vec2 way;
uniform float sigma;
out vec4 made;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), size = textureSize(image, 0);
  vec4 sum = vec4(0);
  float weights = 0.0;
  int far = int(ceil(3.5 * sigma));
  for (int i = -far; i <= far; ++i) {
    ivec2 there = here + i * ivec2(way);
    if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, size))) continue;
    float w = exp(-0.5 * float(i * i) / (sigma * sigma));
    sum += w * texelFetch(image, there, 0), weights += w;
  }
  made = sum / weights;
}`);
    this.mix = kit.program(`
uniform sampler2D sharp, small, large, index;
out vec4 made;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  float d = texelFetch(index, here, 0).x, rest = 1.0 - d;
  made = d * texelFetch(sharp, here, 0) + d * rest * texelFetch(small, here, 0) + rest * rest * texelFetch(large, here, 0);
}`);
  }

  /** offset: added to depth 0…1 over 29.9 m; radius_px: of the larger blur, whose variance is a disc's, r^2/4 */
  draw({ colour, depth }, { offset, radius_px }) {
    const { kit } = this, { width, height } = colour, of = (name) => kit.target(name, width, height), sharp = colour;
    const buffers = { index: of("index"), sharp, rows: of("rows"), small: of("small"), large: of("large"), result: of("result") };
    kit.draw(this.index, [buffers.index], { depth, offset, range: 29.9 });
    for (const [name, radius] of [["small", radius_px / 2], ["large", radius_px]]) {
      kit.draw(this.blur, [buffers.rows], { image: sharp, way: [1, 0], sigma: radius / 2 });
      kit.draw(this.blur, [buffers[name]], { image: buffers.rows, way: [0, 1], sigma: radius / 2 });
    }
    kit.draw(this.mix, [buffers.result], buffers);
    return buffers;
  }
}

/** A centre and rings of n, 2n, 3n … points in the unit disc. */
function discOf(taps) {
  const first = taps === 16 ? 5 : 7, places = [0, 0];
  let rings = 0;
  for (let total = 1; total < taps; total += first * rings) rings++;
  for (let ring = 1; ring <= rings; ring++)
    for (let i = 0; i < first * ring; i++) {
      const radius = (ring + 1 / first) / (rings + 1 / first), angle = (2 * Math.PI * i) / (first * ring);
      places.push(radius * Math.cos(angle), radius * Math.sin(angle));
    }
  return new Float32Array(places);
}

/** Gather, as Catlike Coding, Kino Bokeh and "A Life of a Bokeh" have it: half resolution, near and far apart. */
export class Gather {
  constructor(kit) {
    this.kit = kit;
    this.coc = kit.program(`
uniform sampler2D depth;
uniform float focus, most;
out vec4 made;
void main() {
  float z = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).x;
  made = vec4(vec3(clamp(1.0 - focus / z, -1.0, 1.0) * most), 1);
}`);
    this.half = kit.program(`
uniform sampler2D colour, coc;
layout(location = 0) out vec4 made;
layout(location = 1) out vec4 radius;
void main() {
  ivec2 first = 2 * ivec2(gl_FragCoord.xy), last = textureSize(colour, 0) - 1;
  made = vec4(0), radius = vec4(0);
  for (int i = 0; i < 4; ++i) {
    ivec2 there = min(first + ivec2(i & 1, i >> 1), last);
    made += 0.25 * texelFetch(colour, there, 0), radius += 0.25 * texelFetch(coc, there, 0);
  }
}`);
    this.disc = kit.program(`${BILINEAR}
uniform sampler2D half_colour, half_coc;
uniform vec2 places[71];
uniform int taps;
uniform float most;
layout(location = 0) out vec4 made;
void main() {
  vec4 far = vec4(0), near = vec4(0);
  float far_weight = 0.0, near_weight = 0.0;
  for (int i = 0; i < taps; ++i) {
    vec2 there = gl_FragCoord.xy + 0.5 * most * places[i];
    float distance_px = most * length(places[i]), c = between(half_coc, there).x;
    vec4 light = between(half_colour, there);
    float f = clamp(c - distance_px, 0.0, 1.0), n = clamp(-c - distance_px, 0.0, 1.0);
    far += f * light, far_weight += f, near += n * light, near_weight += n;
  }
  if (far_weight > 0.0) far /= far_weight;
  if (near_weight > 0.0) near /= near_weight;
  float alpha = min(1.0, near_weight);
  made = vec4(mix(far.rgb, near.rgb, alpha), alpha);
}`);
    this.tent = kit.program(`${BILINEAR}
uniform sampler2D image;
out vec4 made;
void main() {
  made = vec4(0);
  for (int i = 0; i < 4; ++i) made += 0.25 * between(image, gl_FragCoord.xy + vec2(i & 1, i >> 1) - 0.5);
}`);
    this.combine = kit.program(`${BILINEAR}
uniform sampler2D colour, coc, soft;
out vec4 made;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 sharp = texelFetch(colour, here, 0), blurred = between(soft, 0.5 * gl_FragCoord.xy);
  float far = smoothstep(0.2, 1.2, texelFetch(coc, here, 0).x), near = blurred.a;
  made = vec4(mix(mix(sharp.rgb, blurred.rgb, far), blurred.rgb, near), 1);
}`);
  }

  draw({ colour, depth }, { focus_m, radius_px, taps }) {
    const { kit } = this, { width, height } = colour, of = (name, scale = 1) => kit.target(`gather ${name}`, Math.ceil(width / scale), Math.ceil(height / scale));
    const b = { sharp: colour, coc: of("coc"), half: of("half", 2), radius: of("radius", 2), disc: of("disc", 2), tent: of("tent", 2), result: of("result") };
    kit.draw(this.coc, [b.coc], { depth, focus: focus_m, most: radius_px });
    kit.draw(this.half, [b.half, b.radius], { colour, coc: b.coc });
    kit.draw(this.disc, [b.disc], { half_colour: b.half, half_coc: b.radius, places: { points: discOf(taps) }, taps: { int: taps }, most: radius_px });
    kit.draw(this.tent, [b.tent], { image: b.disc });
    kit.draw(this.combine, [b.result], { colour, coc: b.coc, soft: b.tent });
    return b;
  }
}

const ATLAS = `
uniform ivec2 size;
uniform int every, levels;
const int kBorder = 12;
int texels(int pixels, int level) { return (pixels + (1 << level) - 1) >> level; }
ivec2 corner_of(int level, bool near) {
  ivec2 corner = ivec2(near ? size.x + 2 * kBorder * levels : 0, 0) + kBorder;
  if (level == 0) return corner;
  corner.y += size.y + 2 * kBorder;
  for (int l = 1; l < level; ++l) corner.x += texels(size.x, l) + 2 * kBorder;
  return corner;
}
vec2 atlas_size() { return vec2(2 * (size.x + 2 * kBorder * levels), size.y + texels(size.y, 1) + 4 * kBorder); }
float radius_of(float z, float focus, float most) { return clamp(1.0 - focus / z, -1.0, 1.0) * most; }
`;

/** HexaDrive: one sprite for each pixel in one draw, levels of detail side by side in one buffer. As examples/instanced_sprites. */
export class HexaDrive {
  constructor(kit) {
    this.kit = kit;
    const common = ATLAS.replaceAll("uniform ivec2 size;", "uniform vec2 size_px;\n#define size ivec2(size_px)");
    this.sprites = kit.program(`
flat in vec4 light;
in vec2 pupil;
flat in vec2 field;
flat in float texels_per_pupil;
out vec4 made;
void main() {
  float outside = -1.0;
  for (int i = 0; i < 5; ++i) {
    float angle = (float(i) + 0.5) * 1.2566371 - 1.5707963;
    outside = max(outside, dot(pupil, vec2(cos(angle), sin(angle))) - cos(0.62831853));
  }
  outside = max(outside, length(pupil + 0.55 * field) - 1.1);
  made = light * clamp(0.5 - outside * texels_per_pupil, 0.0, 1.0);
}`, { common, vertex: `
uniform sampler2D colour, depth;
uniform float focus, most;
flat out vec4 light;
out vec2 pupil;
flat out vec2 field;
flat out float texels_per_pupil;
void main() {
  int across = (size.x + every - 1) / every;
  ivec2 first = every * ivec2(gl_InstanceID % across, gl_InstanceID / across);
  vec4 sum = vec4(0);
  for (int i = 0; i < every * every; ++i) sum += texelFetch(colour, min(first + ivec2(i % every, i / every), size - 1), 0);
  float radius = radius_of(texelFetch(depth, min(first + every / 2, size - 1), 0).x, focus, most), wide = abs(radius);
  gl_Position = vec4(2, 2, 0, 1);
  light = vec4(0), pupil = vec2(0), field = vec2(0), texels_per_pupil = 1.0;
  if (!(wide >= 0.5)) return;
  int level = clamp(int(ceil(log2(wide / 8.0))), 0, levels - 1);
  float scale = float(1 << level);
  texels_per_pupil = wide / scale;
  vec2 corner = (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0) * (1.0 + 1.0 / texels_per_pupil);
  pupil = radius < 0.0 ? -corner : corner;
  vec2 middle = vec2(first) + 0.5 * float(every);
  vec2 place = vec2(corner_of(level, radius < 0.0)) + (middle + wide * corner) / scale;
  gl_Position = vec4(2.0 * place / atlas_size() - 1.0, 0, 1);
  light = sum / (2.3776413 * wide * wide);
  field = (middle - 0.5 * vec2(size)) / (0.5 * length(vec2(size)));
}` });
    this.composite = kit.program(`${BILINEAR}
uniform sampler2D colour, depth, atlas;
uniform float focus, most;
out vec4 made;
vec4 all_levels(vec2 pixel, bool near) {
  vec4 sum = vec4(0);
  for (int level = 0; level < levels; ++level) sum += between(atlas, vec2(corner_of(level, near)) + pixel / float(1 << level));
  return sum;
}
// What a near thing hides: the mean of what is farther, just outside of what its own disc covers; lamps hardly count.
vec4 hidden(ivec2 here, float wide, vec4 near) {
  vec4 sum = vec4(0);
  for (int i = 0; i < 8; ++i) {
    vec2 way = vec2(cos(0.785398 * float(i)), sin(0.785398 * float(i)));
    ivec2 there = clamp(here + ivec2(round((wide + 1.0) * way)), ivec2(0), size - 1);
    vec4 light = vec4(texelFetch(colour, there, 0).rgb, 1);
    if (radius_of(texelFetch(depth, there, 0).x, focus, most) > -0.5 * wide) sum += light / (1.0 + dot(light.rgb, light.rgb));
  }
  return sum.a > 0.0 ? sum / sum.a : near / max(near.a, 1e-4);
}
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 sharp = texelFetch(colour, here, 0), far = all_levels(gl_FragCoord.xy, false), near = all_levels(gl_FragCoord.xy, true);
  float radius = radius_of(texelFetch(depth, here, 0).x, focus, most);
  vec4 blurred = far / max(far.a, 1e-4);
  if (radius < 0.0) blurred = mix(hidden(here, -radius, near), blurred, smoothstep(0.1, 0.5, far.a));
  vec4 back = mix(sharp, blurred, smoothstep(0.5, 1.5, abs(radius)));
  made = vec4((near / max(near.a, 1.0) + (1.0 - min(near.a, 1.0)) * back).rgb, 1);
}`, { common });
  }

  draw({ colour, depth }, { focus_m, radius_px, every }) {
    const { kit } = this, { gl } = kit, { width, height } = colour, levels = Math.max(1, 1 + Math.ceil(Math.log2(radius_px / 8)));
    const atlas = kit.target("atlas", 2 * (width + 24 * levels), height + Math.ceil(height / 2) + 48, kit.blends32 ? gl.RGBA32F : gl.RGBA16F);
    const result = kit.target("hexadrive result", width, height), count = Math.ceil(width / every) * Math.ceil(height / every);
    const inputs = { colour, depth, focus: focus_m, most: radius_px, size_px: [width, height], every: { int: every }, levels: { int: levels } };
    kit.aim([atlas]);
    gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    kit.draw(this.sprites, [atlas], inputs, () => gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count));
    gl.disable(gl.BLEND);
    kit.draw(this.composite, [result], { ...inputs, atlas });
    return { sharp: colour, atlas, result, count };
  }
}
