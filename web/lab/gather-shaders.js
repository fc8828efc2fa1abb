// The programs of gather-pass.js. Targets have one cell more on every side than the picture's grid: cell c is texel c + 1.

const HEAD = `#version 300 es
precision highp float; precision highp int; precision highp sampler2D; precision highp isampler2D; precision highp usampler2D;
`;

/** Squares of 8 x 8 texels, one an instance. */
const BLOCKS = `${HEAD}
layout(location = 0) in ivec2 block;
uniform vec2 target_size;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4((vec2(block) + corner) * 8.0 / target_size * 2.0 - 1.0, 0, 1);
}`;

const WHOLE = `${HEAD}
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }`;

/** Lights of one turn as points, each in its cell: colour; covered, beyond, zone, 1. */
const LIGHTS = {
  vertex: `${HEAD}
layout(location = 0) in uvec2 place_zone;
layout(location = 1) in vec4 colour;
layout(location = 2) in vec2 area;
uniform vec2 target_size;
flat out vec4 of_cell, rest;
void main() {
  vec2 cell = vec2(place_zone.x & 0xffffu, place_zone.x >> 16);
  gl_Position = vec4((cell + 0.5) / target_size * 2.0 - 1.0, 0, 1);
  gl_PointSize = 1.0;
  of_cell = colour, rest = vec4(area, float(place_zone.y), 1);
}`,
  fragment: `${HEAD}
flat in vec4 of_cell, rest;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 area;
void main() { colour = of_cell, area = rest; }`,
};

/** The light that arrives at a cell: under every tap of the kernels within "reach", as the engine gather sums it. */
const GATHER = {
  vertex: BLOCKS,
  fragment: `${HEAD}
uniform sampler2D lights, areas, weights;
uniform isampler2D kernels, kernel_of_zone;
uniform ivec4 reach;
uniform ivec2 size;
uniform bvec4 goes_on;
uniform int turn;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 area;
void main() {
  ivec2 cell = ivec2(gl_FragCoord.xy) - 1;
  colour = vec4(0), area = vec4(0);
  for (int y = reach.y; y < reach.w; ++y)
    for (int x = reach.x; x < reach.z; ++x) {
      ivec2 from = cell - ivec2(x, y), there = clamp(from, ivec2(0), size - 1);
      vec4 rest = texelFetch(areas, there, 0);
      if (rest.w == 0.0) continue;
      int kernel = texelFetch(kernel_of_zone, ivec2(int(rest.z), turn), 0).x;
      if (kernel < 0) continue;
      ivec4 corner = texelFetch(kernels, ivec2(0, kernel), 0);
      int wide = texelFetch(kernels, ivec2(1, kernel), 0).x;
      ivec2 tap = ivec2(x, y) - corner.yz;
      if (tap.x < 0 || tap.y < 0 || tap.x >= corner.w || tap.y >= wide) continue;
      int i = corner.x + tap.y * corner.w + tap.x;
      vec4 weight = texelFetch(weights, ivec2(i & 2047, i >> 11), 0);
      if (there != from) {
        bool on = (from.x >= 0 || goes_on.x) && (from.y >= 0 || goes_on.y) && (from.x < size.x || goes_on.z) && (from.y < size.y || goes_on.w);
        float all_of_it = rest.x + rest.y;
        area.xy += weight.a * (on ? vec2(0, all_of_it) : vec2(all_of_it, 0));
        continue;
      }
      colour += weight * texelFetch(lights, there, 0);
      area.xy += weight.a * rest.xy;
    }
}`,
};

const BILINEAR = `
vec4 between(sampler2D image, vec2 place) {
  ivec2 low = ivec2(floor(place));
  vec2 share = place - vec2(low);
  ivec2 last = textureSize(image, 0) - 1;
  #define AT(x, y) texelFetch(image, clamp(low + ivec2(x, y), ivec2(0), last), 0)
  return mix(mix(AT(0, 0), AT(1, 0), share.x), mix(AT(0, 1), AT(1, 1), share.x), share.y);
}`;

/** Each cell gives what arrives the lens area it takes, or the rest. Stored: 1 - free, and what a seam (RingSizes::Turn) took of it. */
const TAKE = {
  vertex: BLOCKS,
  fragment: `${HEAD}${BILINEAR}
uniform sampler2D sums, taken, gathered, areas, skirts, skirt_areas;
uniform float skirt_scale;
uniform bool is_opaque, is_seam;
layout(location = 0) out vec4 sum;
layout(location = 1) out vec4 full;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 light = texelFetch(gathered, here, 0);
  vec2 area = texelFetch(areas, here, 0).xy;
  if (skirt_scale > 0.0) {
    vec2 place = (vec2(here) - 0.5) * skirt_scale + 0.5;
    light += between(skirts, place);
    area += between(skirt_areas, place).xy;
  }
  vec2 before = texelFetch(taken, here, 0).xy;
  float free = 1.0 - before.x;
  if (is_seam) {
    float covered = min(area.x + area.y, 1.0), seam = min(covered * min(before.x / max(1.0 - covered, 1e-6), 1.0), free);
    sum = texelFetch(sums, here, 0);
    full = vec4(before.x + seam, seam, 0, 0);
    return;
  }
  bool covers = area.x > 1e-6;
  float takes = covers ? min(area.x + area.y, free) : 0.0, share = covers ? takes / area.x : free;
  if (is_opaque) light.a = area.x;
  sum = texelFetch(sums, here, 0) + share * light;
  full = vec4(1.0 - (free - takes), before.y, 0, 0);
}`,
};

/** Cells of a coarse group enlarged onto pixels, which give them what is left of their lens. */
const ENLARGE = {
  vertex: BLOCKS,
  fragment: `${HEAD}${BILINEAR}
uniform sampler2D sums, taken, cells, cells_taken;
uniform float scale;
layout(location = 0) out vec4 sum;
layout(location = 1) out vec4 full;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec2 place = (vec2(here) - 0.5) * scale + 0.5;
  vec4 of_cells = between(cells_taken, place);
  float area = of_cells.x - of_cells.y, free = 1.0 - texelFetch(taken, here, 0).x;
  bool covers = area > 1e-6;
  float takes = covers ? min(area, free) : 0.0, share = covers ? takes / area : free;
  sum = texelFetch(sums, here, 0) + share * between(cells, place);
  full = vec4(1.0 - (free - takes));
}`,
};

const COPY = {
  vertex: BLOCKS,
  fragment: `${HEAD}
uniform sampler2D sums, taken;
layout(location = 0) out vec4 sum;
layout(location = 1) out vec4 full;
void main() { sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0), full = texelFetch(taken, ivec2(gl_FragCoord.xy), 0); }`,
};

const FINISH = {
  vertex: WHOLE,
  fragment: `${HEAD}
uniform sampler2D sums, taken;
out vec4 picture;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy) + 1;
  float full = texelFetch(taken, here, 0).x;
  picture = full > 1e-6 ? texelFetch(sums, here, 0) / full : vec4(0);
}`,
};

/** Pixels that stay as they were, as points. */
const SHARP = {
  vertex: `${HEAD}
layout(location = 0) in uint place;
layout(location = 1) in vec4 colour;
uniform vec2 target_size;
flat out vec4 light;
void main() {
  gl_Position = vec4((vec2(place & 0xffffu, place >> 16) + 0.5) / target_size * 2.0 - 1.0, 0, 1);
  gl_PointSize = 1.0;
  light = colour;
}`,
  fragment: `${HEAD}
flat in vec4 light;
out vec4 picture;
void main() { picture = light; }`,
};

/** Bright points: the whole kernel of each as an instanced sprite, dimmed by its mask of the pupil. */
const SPRITES = {
  vertex: `${HEAD}
precision highp isampler2D;
layout(location = 0) in ivec4 level_kernel_place;
layout(location = 1) in vec4 light_radius;
layout(location = 2) in uvec2 mask;
uniform isampler2D kernels;
uniform vec2 target_size;
flat out ivec4 corner_wide;
flat out ivec2 cell;
flat out vec4 light;
flat out uvec2 seen;
void main() {
  ivec4 kept = texelFetch(kernels, ivec2(0, level_kernel_place.y), 0);
  int high = texelFetch(kernels, ivec2(1, level_kernel_place.y), 0).x;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 at = vec2(level_kernel_place.zw + 1 + kept.yz) + corner * vec2(kept.w, high);
  gl_Position = vec4(at / target_size * 2.0 - 1.0, 0, 1);
  corner_wide = kept, cell = level_kernel_place.zw, light = light_radius, seen = mask;
}`,
  fragment: `${HEAD}
uniform sampler2D weights;
uniform float stretch;
flat in ivec4 corner_wide;
flat in ivec2 cell;
flat in vec4 light;
flat in uvec2 seen;
out vec4 sum;
float bit(uint row, int i) { return float((row >> uint(i)) & 1u); }
uint row_of(int y) { return ((y < 4 ? seen.x : seen.y) >> uint(8 * (y & 3))) & 255u; }
float open_at(vec2 offset) {
  if ((seen.x & seen.y) == 0xffffffffu) return 1.0;
  vec2 place = offset / (light.a < 0.0 ? min(light.a, -0.5) : max(light.a, 0.5));
  place.y /= stretch;
  vec2 p = clamp((place + 1.0) * 4.0 - 0.5, vec2(0), vec2(7));
  ivec2 c = min(ivec2(p), ivec2(6));
  vec2 share = p - vec2(c);
  uint first = row_of(c.y), second = row_of(c.y + 1);
  return mix(mix(bit(first, c.x), bit(first, c.x + 1), share.x), mix(bit(second, c.x), bit(second, c.x + 1), share.x), share.y);
}
void main() {
  ivec2 offset = ivec2(gl_FragCoord.xy) - 1 - cell, tap = offset - corner_wide.yz;
  int i = corner_wide.x + tap.y * corner_wide.w + tap.x;
  sum = vec4(texelFetch(weights, ivec2(i & 2047, i >> 11), 0).rgb * light.rgb * open_at(vec2(offset)), 0);
}`,
};

/** Sprites on coarse cells, enlarged; drawn with light added. */
const ADD = {
  vertex: WHOLE,
  fragment: `${HEAD}${BILINEAR}
uniform sampler2D cells;
uniform float scale;
out vec4 sum;
void main() { sum = scale * scale * between(cells, gl_FragCoord.xy * scale + 0.5); }`,
};

/** Light as sRGB codes, top row first. */
const SHOW = {
  vertex: WHOLE,
  fragment: `${HEAD}
uniform sampler2D picture;
uniform float exposure;
out vec4 code;
void main() {
  ivec2 size = textureSize(picture, 0), here = ivec2(gl_FragCoord.xy);
  vec3 light = max(texelFetch(picture, ivec2(here.x, size.y - 1 - here.y), 0).rgb * exposure, vec3(0));
  code = vec4(mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light)), 1);
}`,
};

export const PROGRAMS = { LIGHTS, GATHER, TAKE, ENLARGE, COPY, FINISH, SHARP, SPRITES, ADD, SHOW };
