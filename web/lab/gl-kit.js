// WebGL2 in a few words: programs, targets of floats, draws.

const HEAD = `#version 300 es
precision highp float; precision highp int; precision highp sampler2D;
`;
const WHOLE = "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }";

export class Kit {
  /** @throws {Error} with a sentence where this browser cannot */
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL2, which these pictures need");
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("this browser's WebGL2 cannot draw into pictures of floats");
    this.gl = gl;
    this.blends32 = Boolean(gl.getExtension("EXT_float_blend"));
    gl.getExtension("OES_texture_float_linear");
    this.frame = gl.createFramebuffer();
    this.targets = new Map();
  }

  /** A fragment program over the whole target, or with vertices of its own; common: text before both. */
  program(fragment, { vertex = WHOLE, common = "" } = {}) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, HEAD + common + text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`this browser's WebGL2 refuses a program: ${gl.getShaderInfoLog(shader)}`);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`this browser's WebGL2 refuses a program: ${gl.getProgramInfoLog(program)}`);
    const places = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      places[name.replace("[0]", "")] = gl.getUniformLocation(program, name);
    }
    return { program, places };
  }

  /** A picture of floats of this name, kept while its size is asked for. */
  target(name, width, height, format = this.gl.RGBA32F) {
    const gl = this.gl, known = this.targets.get(name);
    if (known?.width === width && known.height === height) return known;
    if (known) gl.deleteTexture(known.texture);
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    const made = { texture, width, height };
    this.targets.set(name, made);
    return made;
  }

  /** Aims at targets, or at the canvas where there are none. @param {?WebGLRenderbuffer} depth */
  aim(targets, depth = null) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets.length ? this.frame : null);
    if (!targets.length) return gl.viewport(0, 0, gl.canvas.width, gl.canvas.height);
    [0, 1].forEach((i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, targets[i]?.texture ?? null, 0));
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    gl.drawBuffers(targets.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    gl.viewport(0, 0, targets[0].width, targets[0].height);
  }

  /** Draws with a program: inputs are targets, floats, arrays of 2 to 4 floats, or {int}. */
  draw({ program, places }, targets, inputs = {}, call = () => this.gl.drawArrays(this.gl.TRIANGLES, 0, 3), depth = null) {
    const gl = this.gl;
    gl.useProgram(program);
    let unit = 0;
    for (const [name, value] of Object.entries(inputs)) {
      const place = places[name];
      if (!place) continue;
      if (value.texture) {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, value.texture);
        gl.uniform1i(place, unit++);
      } else if (value.int !== undefined) gl.uniform1i(place, value.int);
      else if (value.points) gl.uniform2fv(place, value.points);
      else if (Array.isArray(value)) gl[`uniform${value.length}f`](place, ...value);
      else gl.uniform1f(place, value);
    }
    this.aim(targets, depth);
    call();
  }

  /** r, g, b, a of a target, top row first (targets hold pictures that way up). */
  pixels(target) {
    const pixels = new Float32Array(4 * target.width * target.height);
    this.aim([target]);
    this.gl.readPixels(0, 0, target.width, target.height, this.gl.RGBA, this.gl.FLOAT, pixels);
    return pixels;
  }
}

/** Reads like a texture unit: bilinear, clamped; the middle of texel 0 is 0.5. */
export const BILINEAR = `
vec4 between(sampler2D image, vec2 place) {
  place -= 0.5;
  ivec2 low = ivec2(floor(place)), last = textureSize(image, 0) - 1;
  vec2 share = place - vec2(low);
  #define AT(x, y) texelFetch(image, clamp(low + ivec2(x, y), ivec2(0), last), 0)
  return mix(mix(AT(0, 0), AT(1, 0), share.x), mix(AT(0, 1), AT(1, 1), share.x), share.y);
}
`;
