// Draws in WebGL2 what the engine "gather" plans: lights by turn into cells, gathered under the lens's kernels, near before
// far; bright points as sprites. Words as src/device/webgl hands them over.
import { PROGRAMS } from "./gather-shaders.js";

const BLOCK = 8, LIGHT_WORDS = 8, SPRITE_WORDS = 10, SHARP_WORDS = 5, KERNEL_WORDS = 5, WEIGHTS_ACROSS = 2048;

/** Squares of 8 x 8 texels of a target that something is drawn in. */
class Blocks {
  constructor({ width, height }) {
    this.across = Math.ceil((width + 2) / BLOCK);
    this.down = Math.ceil((height + 2) / BLOCK);
    this.lit = new Uint8Array(this.across * this.down);
  }
  /** Marks the blocks that texels x0…x1-1, y0…y1-1 lie in. */
  mark(x0, y0, x1, y1) {
    const left = Math.max(0, Math.floor(x0 / BLOCK)), right = Math.min(this.across, Math.ceil(x1 / BLOCK));
    const top = Math.max(0, Math.floor(y0 / BLOCK)), bottom = Math.min(this.down, Math.ceil(y1 / BLOCK));
    for (let y = top; y < bottom; y++) this.lit.fill(1, y * this.across + left, Math.max(y * this.across + right, y * this.across + left));
  }
  each(visit) {
    for (let i = 0; i < this.lit.length; i++) if (this.lit[i]) visit((i % this.across) * BLOCK, Math.floor(i / this.across) * BLOCK);
  }
  /** Of another grid whose cells are `scale` times as small, with what enlarging reads around each. */
  scaled(scale, grid) {
    const made = new Blocks(grid);
    this.each((x, y) => made.mark((x - 2) * scale, (y - 2) * scale, (x + BLOCK + 1) * scale, (y + BLOCK + 1) * scale));
    return made;
  }
  with(other) {
    other.lit.forEach((lit, i) => lit && (this.lit[i] = 1));
    return this;
  }
  list() {
    const places = [];
    this.each((x, y) => places.push(x / BLOCK, y / BLOCK));
    return new Int16Array(places);
  }
}

export class GatherPass {
  #gl; #programs = {}; #buffers = {}; #kept = new Map(); #size = "";

  /** @throws {Error} with a sentence where this browser cannot */
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL2, which the live picture needs");
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("this browser's WebGL2 cannot draw into pictures of floats");
    // Sprites are added up: in halves where floats cannot be.
    this.sumFormat = gl.getExtension("EXT_float_blend") ? gl.RGBA32F : gl.RGBA16F;
    this.#gl = gl;
    for (const [name, { vertex, fragment }] of Object.entries(PROGRAMS)) this.#programs[name] = this.#program(vertex, fragment);
    for (const name of ["blocks", "lights", "sharp", "sprites"]) this.#buffers[name] = gl.createBuffer();
    this.frame = gl.createFramebuffer();
  }

  #program(vertex, fragment) {
    const gl = this.#gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      const log = [...gl.getAttachedShaders(program).map((s) => gl.getShaderInfoLog(s)), gl.getProgramInfoLog(program)];
      throw new Error(`this browser's WebGL2 cannot run the live picture: ${log.filter(Boolean).join(" ")}`);
    }
    const places = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      places[name] = gl.getUniformLocation(program, name);
    }
    return { program, places };
  }

  #texture(name, width, height, format, data = null) {
    const gl = this.#gl;
    const texture = this.#kept.get(name) ?? gl.createTexture();
    this.#kept.set(name, texture);
    const [part, kind] = { [gl.RGBA32F]: [gl.RGBA, gl.FLOAT], [gl.RGBA16F]: [gl.RGBA, gl.HALF_FLOAT], [gl.RGBA32I]: [gl.RGBA_INTEGER, gl.INT], [gl.R32I]: [gl.RED_INTEGER, gl.INT] }[format];
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, part, kind, data);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    texture.size = [width, height];
    return texture;
  }

  /** Textures of one size that are drawn into and keep their place from frame to frame. */
  #target(name, width, height, format = this.#gl.RGBA32F) {
    const known = this.#kept.get(name);
    return known && known.size[0] === width && known.size[1] === height ? known : this.#texture(name, width, height, format);
  }

  /** Binds textures, uniforms and the target of the next draw. */
  #use(name, targets, textures = {}, uniforms = {}) {
    const gl = this.#gl, { program, places } = this.#programs[name];
    gl.useProgram(program);
    Object.entries(textures).forEach(([uniform, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(places[uniform], unit);
    });
    for (const [uniform, [call, ...values]] of Object.entries(uniforms)) if (places[uniform]) gl[`uniform${call}`](places[uniform], ...values);
    this.#aim(targets);
    if (targets.length && places.target_size) gl.uniform2f(places.target_size, ...targets[0].size);
  }

  #aim(targets) {
    const gl = this.#gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets.length ? this.frame : null);
    if (!targets.length) return;
    [0, 1].forEach((i) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, targets[i] ?? null, 0));
    gl.drawBuffers(targets.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    gl.viewport(0, 0, ...targets[0].size);
  }

  #clear(targets, ...values) {
    this.#aim(targets);
    values.forEach((value, i) => this.#gl.clearBufferfv(this.#gl.COLOR, i, value));
  }

  /** Attributes of interleaved words: [place, how many, kind, first word]. */
  #attributes(buffer, words, list, divisor = 0, offset = 0) {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    for (let i = 0; i < 3; i++) gl.disableVertexAttribArray(i);
    for (const [place, count, kind, first] of list) {
      gl.enableVertexAttribArray(place);
      if (kind === gl.FLOAT) gl.vertexAttribPointer(place, count, kind, false, 4 * words, 4 * (first + offset));
      else gl.vertexAttribIPointer(place, count, kind, 4 * words, 4 * (first + offset));
      gl.vertexAttribDivisor(place, divisor);
    }
  }

  #drawBlocks(blocks) {
    const gl = this.#gl, list = blocks.list();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.blocks);
    gl.bufferData(gl.ARRAY_BUFFER, list, gl.STREAM_DRAW);
    for (let i = 1; i < 3; i++) gl.disableVertexAttribArray(i);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribIPointer(0, 2, gl.SHORT, 0, 0);
    gl.vertexAttribDivisor(0, 1);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, list.length / 2);
  }

  #drawWhole() {
    for (let i = 0; i < 3; i++) this.#gl.disableVertexAttribArray(i);
    this.#gl.drawArrays(this.#gl.TRIANGLES, 0, 3);
  }

  /** Records of kernels (first weight, corner, width; height) and their weights, as textures. */
  #kernels(name, records, weights) {
    const gl = this.#gl, count = records.length / KERNEL_WORDS, table = new Int32Array(8 * Math.max(1, count));
    for (let i = 0; i < count; i++) {
      const [first, x, y, width, height] = records.subarray(KERNEL_WORDS * i, KERNEL_WORDS * (i + 1));
      table.set([first, x | 0, y | 0, width, height], 8 * i);
    }
    const rows = Math.max(1, Math.ceil(weights.length / 4 / WEIGHTS_ACROSS));
    if (Math.max(rows, count) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) throw new Error("this lens has more kernels than this browser's WebGL2 holds; Develop draws it");
    const padded = new Float32Array(4 * WEIGHTS_ACROSS * rows);
    padded.set(new Float32Array(weights.buffer, weights.byteOffset, weights.length));
    return {
      table, records: this.#texture(`${name} kernels`, 2, Math.max(1, count), gl.RGBA32I, table),
      weights: this.#texture(`${name} weights`, WEIGHTS_ACROSS, rows, gl.RGBA32F, padded),
    };
  }

  /** Draws a frame into a texture of floats. @param {Object<string, Uint32Array>} handed by name */
  draw(handed) {
    const gl = this.#gl, [width, height, levels, zones, opaque, ...goesOn] = handed["gather head"];
    if (this.#size !== `${width} ${height}`) this.#forget();
    this.#size = `${width} ${height}`;
    Object.assign(this, { width, height, zones, goesOn, opaque });
    this.grids = Array.from({ length: levels }, (_, level) => ({ level, width: (width + (1 << level) - 1) >> level, height: (height + (1 << level) - 1) >> level }));
    this.kernels = this.#kernels("gather", handed["gather kernels"], handed["gather weights"]);
    const turns = this.#turns(handed["gather turns"]);
    this.words = handed["gather lights"];
    gl.disable(gl.BLEND);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.lights);
    gl.bufferData(gl.ARRAY_BUFFER, this.words, gl.STREAM_DRAW);
    const tile = this.#sums("tile", this.grids[0]);
    for (let begin = 0, end; begin < turns.length; begin = end) {
      for (end = begin; end < turns.length && turns[end].level === turns[begin].level; end++);
      this.#group(turns.slice(begin, end), tile);
    }
    this.picture = this.#target("picture", width, height, this.sumFormat);
    this.#use("FINISH", [this.picture], { sums: tile.sum, taken: tile.taken });
    this.#drawWhole();
    this.#drawSharp(handed["gather sharp"]);
    if (handed["lights list"]?.length) this.#drawSprites(handed);
  }

  #forget() {
    for (const texture of this.#kept.values()) this.#gl.deleteTexture(texture);
    this.#kept.clear();
  }

  #turns(words) {
    const each = 7 + 2 * this.zones, count = words.length / each, turns = [];
    const table = new Int32Array(Math.max(1, 2 * count * this.zones));
    for (let t = 0; t < count; t++) {
      const [level, first, lights, coarse, skirtFirst, skirtLights, isSeam, ...kernels] = words.subarray(each * t, each * (t + 1));
      const core = kernels.filter((_, i) => i % 2 === 0), skirt = kernels.filter((_, i) => i % 2 === 1);
      table.set(core.map((k) => k | 0), 2 * t * this.zones);
      table.set(skirt.map((k) => k | 0), (2 * t + 1) * this.zones);
      turns.push({ level, isSeam, core: { level, first, lights, row: 2 * t, reach: this.#reach(core) }, skirt: { level: coarse, first: skirtFirst, lights: skirtLights, row: 2 * t + 1, reach: this.#reach(skirt) } });
    }
    this.kernelOfZone = this.#texture("kernel of zone", this.zones, Math.max(1, 2 * count), this.#gl.R32I, table);
    return turns;
  }

  /** The smallest rectangle of offsets that holds these kernels. */
  #reach(kernels) {
    const reach = [0, 0, 1, 1];
    for (const kernel of kernels) {
      if ((kernel | 0) < 0) continue;
      const [, x, y, width, height] = this.kernels.table.subarray(8 * kernel);
      reach.splice(0, 4, Math.min(reach[0], x), Math.min(reach[1], y), Math.max(reach[2], x + width), Math.max(reach[3], y + height));
    }
    return reach;
  }

  /** A pair of textures that sums go to, and a pair that they are made in. */
  #sums(name, { width, height }) {
    const of = (part) => this.#target(`${name} ${part}`, width + 2, height + 2);
    const sums = { sum: of("sum"), taken: of("taken"), next: of("next sum"), nextTaken: of("next taken") };
    this.#clear([sums.sum, sums.taken], [0, 0, 0, 0], [0, 0, 0, 0]);
    return sums;
  }

  #copy(sums, blocks) {
    this.#use("COPY", [sums.sum, sums.taken], { sums: sums.next, taken: sums.nextTaken });
    this.#drawBlocks(blocks);
  }

  /** Turns of one level, nearest first: combined on that level's cells, then enlarged. */
  #group(turns, tile) {
    const grid = this.grids[turns[0].level], into = grid.level === 0 ? tile : this.#sums(`level ${grid.level}`, grid);
    const all = new Blocks(grid);
    for (const turn of turns) all.with(this.#take(turn, grid, into));
    if (grid.level === 0) return;
    const blocks = all.scaled(1 << grid.level, this.grids[0]);
    this.#use("ENLARGE", [tile.next, tile.nextTaken], { sums: tile.sum, taken: tile.taken, cells: into.sum, cells_taken: into.taken }, { scale: ["1f", 1 / (1 << grid.level)] });
    this.#drawBlocks(blocks);
    this.#copy(tile, blocks);
  }

  #take({ isSeam, core, skirt }, grid, into) {
    const blocks = this.#lit(core);
    const coarse = skirt.lights ? this.grids[skirt.level] : null;
    let skirts = [into.sum, into.taken]; // anything: a scale of 0 leaves them out
    if (coarse) {
      const lit = this.#lit(skirt);
      blocks.with(lit.scaled(1 << (coarse.level - grid.level), grid));
      skirts = this.#gather(skirt, coarse, lit.scaled(1, coarse), "skirts");
    }
    const [gathered, areas] = this.#gather(core, grid, blocks, "core");
    this.#use("TAKE", [into.next, into.nextTaken], { sums: into.sum, taken: into.taken, gathered, areas, skirts: skirts[0], skirt_areas: skirts[1] },
      { skirt_scale: ["1f", coarse ? 1 / (1 << (coarse.level - grid.level)) : 0], is_opaque: ["1i", this.opaque], is_seam: ["1i", isSeam] });
    this.#drawBlocks(blocks);
    this.#copy(into, blocks);
    return blocks;
  }

  /** Blocks that lights reach; those at the border also stand for the picture beyond it. */
  #lit({ level, first, lights, reach }) {
    const blocks = new Blocks(this.grids[level]), [x0, y0, x1, y1] = [Math.min(reach[0], -1), Math.min(reach[1], -1), Math.max(reach[2], 2), Math.max(reach[3], 2)];
    const own = new Blocks(this.grids[level]);
    for (let i = first; i < first + lights; i++) {
      const place = this.words[LIGHT_WORDS * i];
      own.lit[(((place >>> 16) + 1) >> 3) * own.across + (((place & 0xffff) + 1) >> 3)] = 1;
    }
    own.each((x, y) => blocks.mark(x + x0, y + y0, x + BLOCK - 1 + x1, y + BLOCK - 1 + y1));
    return blocks;
  }

  #gather({ first, lights, row, reach }, grid, blocks, name) {
    const gl = this.#gl;
    const of = (part, border) => this.#target(`${name} ${part} ${grid.level}`, grid.width + border, grid.height + border);
    const cells = [of("lights", 0), of("areas", 0)], sums = [of("gathered", 2), of("gathered areas", 2)];
    this.#clear(cells, [0, 0, 0, 0], [0, 0, 0, 0]);
    this.#use("LIGHTS", cells);
    this.#attributes(this.#buffers.lights, LIGHT_WORDS, [[0, 2, gl.UNSIGNED_INT, 0], [1, 4, gl.FLOAT, 2], [2, 2, gl.FLOAT, 6]], 0, LIGHT_WORDS * first);
    gl.drawArrays(gl.POINTS, 0, lights);
    this.#use("GATHER", sums, { lights: cells[0], areas: cells[1], weights: this.kernels.weights, kernels: this.kernels.records, kernel_of_zone: this.kernelOfZone },
      { reach: ["4i", ...reach], size: ["2i", grid.width, grid.height], goes_on: ["4i", ...this.goesOn], turn: ["1i", row] });
    this.#drawBlocks(blocks);
    return sums;
  }

  #drawSharp(words) {
    if (!words.length) return;
    const gl = this.#gl;
    this.#use("SHARP", [this.picture]);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.sharp);
    gl.bufferData(gl.ARRAY_BUFFER, words, gl.STREAM_DRAW);
    this.#attributes(this.#buffers.sharp, SHARP_WORDS, [[0, 1, gl.UNSIGNED_INT, 0], [1, 4, gl.FLOAT, 1]]);
    gl.drawArrays(gl.POINTS, 0, words.length / SHARP_WORDS);
  }

  /** Level by level, as they come: onto cells, then onto the picture. */
  #drawSprites(handed) {
    const gl = this.#gl, list = handed["lights list"], count = list.length / SPRITE_WORDS;
    const stretch = new Float32Array(handed["lights head"].buffer, handed["lights head"].byteOffset)[2];
    const { records, weights } = this.#kernels("sprites", handed["lights kernels"], handed["lights weights"]);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffers.sprites);
    gl.bufferData(gl.ARRAY_BUFFER, list, gl.STREAM_DRAW);
    gl.blendFunc(gl.ONE, gl.ONE);
    for (let begin = 0, end; begin < count; begin = end) {
      const level = list[SPRITE_WORDS * begin];
      for (end = begin; end < count && list[SPRITE_WORDS * end] === level; end++);
      const wide = (this.width + (1 << level) - 1) >> level, high = (this.height + (1 << level) - 1) >> level;
      const cells = this.#target(`sprites ${level}`, wide + 2, high + 2, this.sumFormat);
      this.#clear([cells], [0, 0, 0, 0]);
      gl.enable(gl.BLEND);
      this.#use("SPRITES", [cells], { kernels: records, weights }, { stretch: ["1f", stretch] });
      this.#attributes(this.#buffers.sprites, SPRITE_WORDS, [[0, 4, gl.INT, 0], [1, 4, gl.FLOAT, 4], [2, 2, gl.UNSIGNED_INT, 8]], 1, SPRITE_WORDS * begin);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, end - begin);
      this.#use("ADD", [this.picture], { cells }, { scale: ["1f", 1 / (1 << level)] });
      this.#drawWhole();
      gl.disable(gl.BLEND);
    }
  }

  /** Shows the last picture on the canvas. */
  show(exposure_stops) {
    const gl = this.#gl;
    gl.canvas.width = this.width;
    gl.canvas.height = this.height;
    this.#use("SHOW", [], { picture: this.picture }, { exposure: ["1f", 2 ** exposure_stops] });
    gl.viewport(0, 0, this.width, this.height);
    this.#drawWhole();
  }

  /** r, g, b, a of the last picture, row by row from the top. */
  pixels() {
    const gl = this.#gl, pixels = new Float32Array(4 * this.width * this.height);
    this.#aim([this.picture]);
    gl.readPixels(0, 0, this.width, this.height, gl.RGBA, gl.FLOAT, pixels);
    return pixels;
  }
}
