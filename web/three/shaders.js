// The programs of LensPass. A signed radius of the circle of confusion is in pixels, + behind focus.

const HEAD = `precision highp float; precision highp int; precision highp sampler2D;
`;

export const WHOLE = `
out vec2 place;
void main() { place = uv; gl_Position = vec4(position.xy, 0, 1); }`;

/** Linear colour, and the signed radius as alpha. */
export const RADII = `${HEAD}
uniform sampler2D colour, depth;
uniform vec3 optics; // radius = x + y / distance; z: no radius is larger
uniform vec2 unproject; // planar distance = x / (y + depth)
in vec2 place;
out vec4 result;
void main() {
  float d = texture(depth, place).r;
  float distance = unproject.x / (unproject.y + d);
  vec4 light = texture(colour, place);
  result = vec4(clamp(light.rgb, 0.0, 60000.0), clamp(optics.x + optics.y / distance, -optics.z, optics.z));
}`;

/** By tile of 16 x 16 pixels: the largest radius in front of focus and behind it. */
export const TILES = `${HEAD}
uniform sampler2D split;
out vec4 result;
void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * 16, last = textureSize(split, 0) - 1;
  vec2 most = vec2(0);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      float r = texelFetch(split, min(first + ivec2(x, y), last), 0).a;
      most = max(most, vec2(-r, r));
    }
  result = vec4(most, 0, 0);
}`;

/** The largest radius in front of focus that reaches a tile. */
export const REACH = `${HEAD}
uniform sampler2D tiles;
uniform int around;
out vec4 result;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(tiles, 0) - 1;
  vec2 own = texelFetch(tiles, here, 0).xy;
  for (int y = -around; y <= around; ++y)
    for (int x = -around; x <= around; ++x) {
      float r = texelFetch(tiles, clamp(here + ivec2(x, y), ivec2(0), last), 0).x;
      if (r * 1.3 > 16.0 * length(max(abs(vec2(x, y)) - 1.0, 0.0))) own.x = max(own.x, r);
    }
  result = vec4(own, 0, 0);
}`;

/** Discs of the atlas. Needs RADII_COUNT and ZONES. */
const DISCS = `
uniform sampler2D atlas, numbers; // numbers: side in radii of its column, 1 / sums, by zone and radius
uniform vec3 lens; // on this picture, the largest radius of the atlas; texels of a tile's side; pixels for one of the atlas's picture
vec2 half_diagonals(vec2 pixel, vec2 size) { return (pixel - 0.5 * size) / (0.5 * length(size)); }
float column_of(float radius) {
  float t = clamp(radius / lens.x, -1.0, 1.0);
  return (sign(t) * sqrt(abs(t)) + 1.0) * 0.5 * float(RADII_COUNT - 1);
}
float radius_of(float column) { float t = 2.0 * column / float(RADII_COUNT - 1) - 1.0; return lens.x * t * abs(t); }
// Side of the square that a disc of this radius fills, in pixels: linear in the radius between two columns.
float side_of(float radius, float zone) {
  float column = min(floor(column_of(radius)), float(RADII_COUNT - 2)), low = radius_of(column);
  column += clamp((radius - low) / (radius_of(column + 1.0) - low), 0.0, 1.0);
  float side = texture(numbers, (vec2(column, zone * float(ZONES - 1)) + 0.5) / vec2(RADII_COUNT, ZONES)).a * lens.z;
  return side * max(1.0, abs(radius) / lens.x);
}
// The light at a distance from the source, turned to the frame's +x, of a disc of sum 1.
vec3 tile_at(vec2 turned, float side, float column, float row) {
  vec2 inside = turned / side + 0.5;
  if (any(lessThan(inside, vec2(0))) || any(greaterThan(inside, vec2(1)))) return vec3(0);
  inside.y = 1.0 - inside.y;
  vec2 texel = clamp(inside * lens.y, 0.5, lens.y - 0.5);
  vec3 light = texture(atlas, (vec2(column, row) * lens.y + texel) / (lens.y * vec2(RADII_COUNT, ZONES))).rgb;
  return light * texelFetch(numbers, ivec2(column, row), 0).rgb / (side * side);
}
vec3 disc_at(vec2 turned, float radius, float zone) {
  float side = side_of(radius, zone), column = round(column_of(radius)), row = zone * float(ZONES - 1), low = floor(row);
  vec3 light = tile_at(turned, side, column, low);
  return row > low ? mix(light, tile_at(turned, side, column, low + 1.0), row - low) : light;
}
mat2 turn_of(vec2 where) { float far = length(where); vec2 x = far > 1e-4 ? where / far : vec2(1, 0); return mat2(x.x, -x.y, x.y, x.x); }
`;

/** Lamps: what is far brighter than the mean around it; a cell of 2 x 2 pixels has at most one. */
const LAMPS = `
uniform float lamp_factor;
struct Lamp { vec3 light, around; float radius, threshold; vec2 source; };
vec4 pixel_of(ivec2 pixel) { return texelFetch(split, clamp(pixel, ivec2(0), textureSize(split, 0) - 1), 0); }
float sum_of(vec3 light) { return light.r + light.g + light.b; }
// light: of all bright pixels of a cell, above what is around; radius 0: no lamp.
Lamp lamp_of(ivec2 cell) {
  Lamp lamp = Lamp(vec3(0), vec3(0), 0.0, 0.0, vec2(0));
  float most = -1.0, radius = 0.0;
  ivec2 brightest;
  for (int i = 0; i < 4; ++i) {
    ivec2 pixel = 2 * cell + ivec2(i & 1, i >> 1);
    vec4 here = pixel_of(pixel);
    if (sum_of(here.rgb) > most) { most = sum_of(here.rgb); radius = here.a; brightest = pixel; }
  }
  if (lamp_factor <= 0.0 || abs(radius) < 1.5) return lamp;
  // The mean of what is far darker: a neighbour may be the same lamp.
  float dark = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      vec3 there = pixel_of(brightest + 6 * ivec2(x, y)).rgb;
      if (sum_of(there) < 0.25 * most) { lamp.around += there; dark += 1.0; }
    }
  if (dark < 3.0) return lamp;
  lamp.around /= dark;
  lamp.threshold = lamp_factor * sum_of(lamp.around) + 0.5;
  if (most <= lamp.threshold) return lamp;
  lamp.radius = radius;
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 pixel = 2 * cell + ivec2(i & 1, i >> 1);
    vec3 here = pixel_of(pixel).rgb;
    if (pixel != clamp(pixel, ivec2(0), textureSize(split, 0) - 1) || sum_of(here) <= lamp.threshold) continue;
    vec3 above = max(here - lamp.around, 0.0);
    lamp.light += above, lamp.source += sum_of(above) * (vec2(pixel) + 0.5), weights += sum_of(above);
  }
  lamp.source /= weights;
  return lamp;
}`;

/** What is left once lamps are taken out. */
export const WITHOUT_LAMPS = `${HEAD}
uniform sampler2D split;${LAMPS}
out vec4 result;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  Lamp lamp = lamp_of(here / 2);
  result = texelFetch(split, here, 0);
  if (lamp.radius != 0.0 && sum_of(result.rgb) > lamp.threshold) result.rgb = min(result.rgb, lamp.around);
}`;

/** Behind focus and in front of it, gathered apart; alpha: what is in front leaves of the lens. Needs TAPS. */
export const GATHER = `${HEAD}
uniform sampler2D split, reach;${DISCS}
out vec4 result;
const float GOLDEN = 2.39996323;
// Adds light and cover of discs in front with radii from least to most, in pixels.
void in_front(vec2 here, vec2 size, mat2 turn, float zone, float start, float most, float least, inout vec3 near, inout vec3 covered) {
  float extent = 0.55 * side_of(-most, zone), area = 3.14159265 * extent * extent / float(TAPS);
  for (int i = 0; i < TAPS; ++i) {
    float t = float(i) * GOLDEN + start, far = extent * sqrt((float(i) + 0.5) / float(TAPS));
    vec2 from = vec2(cos(t), sin(t)) * far;
    vec4 tap = texture(split, (here + from) / size);
    if (tap.a > -0.5 || -tap.a <= least || -tap.a > most || all(lessThan(abs(from), vec2(0.5)))) continue;
    vec3 weight = disc_at(turn * -from, tap.a, zone) * area;
    near += weight * tap.rgb, covered += weight;
  }
}
void main() {
  vec2 size = vec2(textureSize(split, 0)), here = gl_FragCoord.xy;
  vec4 own = texelFetch(split, ivec2(here), 0);
  vec2 at = half_diagonals(here, size);
  float zone = min(length(at), 1.0), start = 6.2831853 * fract(52.9829189 * fract(dot(here, vec2(0.06711056, 0.00583715))));
  mat2 turn = turn_of(at);
  float near_most = texelFetch(reach, ivec2(here) / 16, 0).x, blur = abs(own.a);
  vec3 back = vec3(0), back_weight = vec3(0), near = vec3(0), covered = vec3(0);
  // Behind: over the own disc; a tap that is farther counts with at most the own radius.
  float wide = blur > 0.5 ? 0.55 * side_of(own.a, zone) : 0.0;
  if (own.a > -0.5) { vec3 whole = blur > 0.5 ? disc_at(vec2(0), max(own.a, 0.5), zone) + 1e-4 : vec3(1); back = whole * own.rgb; back_weight = whole; }
  if (wide > 0.0)
    for (int i = 0; i < TAPS; ++i) {
      float t = float(i) * GOLDEN + start, far = wide * sqrt((float(i) + 0.5) / float(TAPS));
      vec2 from = vec2(cos(t), sin(t)) * far;
      vec4 tap = texture(split, (here + from) / size);
      if (tap.a < -0.5) continue;
      float radius = own.a > 0.0 ? min(tap.a, own.a) : tap.a;
      vec3 weight = own.a > 0.0 ? (radius > 0.5 ? disc_at(turn * -from, radius, zone) : vec3(0)) : vec3(1.0 / (1.0 + far * far));
      back += weight * tap.rgb, back_weight += weight;
    }
  // In front: large discs over the largest radius that reaches this tile; small ones, which few of those taps would meet,
  // over a quarter of it; the own pixel, whose disc may be smaller still.
  float split_at = near_most > 4.0 ? 0.25 * near_most : 0.0;
  if (near_most > 0.5) in_front(here, size, turn, zone, start, near_most, split_at, near, covered);
  if (split_at > 0.0) in_front(here, size, turn, zone, start, split_at, 0.0, near, covered);
  if (own.a < -0.5) { vec3 whole = disc_at(vec2(0), own.a, zone); near += whole * own.rgb; covered += whole; }
  // Each channel is covered by itself, so that surfaces that fill the lens have no tint.
  vec3 cover = clamp(covered, 0.0, 1.0);
  vec3 front = mix(own.rgb, near / max(covered, vec3(1e-4)), step(1e-4, covered));
  vec3 behind = back_weight.g > 1e-6 ? back / max(back_weight, vec3(1e-6)) : front;
  result = vec4(mix(behind, front, cover), 1.0 - dot(cover, vec3(1.0 / 3.0)));
}`;

/** The mean of what neighbours gathered: each pixel turns its taps by another angle. Only wide blurs take it, because it softens. */
export const MEAN = `${HEAD}
uniform sampler2D split, gathered;
out vec4 result;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(gathered, 0) - 1;
  float own = abs(texelFetch(split, here, 0).a), weights = 0.0;
  vec4 sum = vec4(0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      ivec2 pixel = clamp(here + ivec2(x, y), ivec2(0), last);
      float weight = x == 0 && y == 0 ? 1.0 : smoothstep(3.0, 8.0, min(own, abs(texelFetch(split, pixel, 0).a)));
      sum += weight * texelFetch(gathered, pixel, 0), weights += weight;
    }
  result = sum / weights;
}`;

/** One instance a cell; a cell without a lamp draws nothing. */
export const SPRITES = {
  vertex: `${HEAD}
uniform sampler2D split;${DISCS}${LAMPS}
uniform int across;
flat out vec4 light;
flat out vec2 source;
void main() {
  Lamp lamp = lamp_of(ivec2(gl_InstanceID % across, gl_InstanceID / across));
  light = vec4(lamp.light, lamp.radius), source = lamp.source;
  vec2 size = vec2(textureSize(split, 0));
  if (light.a == 0.0) { gl_Position = vec4(2, 2, 2, 1); return; }
  float side = 1.42 * side_of(light.a, min(length(half_diagonals(source, size)), 1.0));
  gl_Position = vec4((source + position.xy * side) / size * 2.0 - 1.0, 0, 1);
}`,
  fragment: `${HEAD}
uniform sampler2D split, gathered;${DISCS}
flat in vec4 light;
flat in vec2 source;
out vec4 result;
void main() {
  vec2 size = vec2(textureSize(split, 0)), at = half_diagonals(source, size);
  float own = texelFetch(split, ivec2(gl_FragCoord.xy), 0).a;
  // A lamp behind is hidden by what is nearer: by surfaces at their pixel, by blurred ones as they cover.
  float seen = light.a > 0.0 ? (own < -0.5 ? 1.0 : smoothstep(light.a - 2.0, light.a - 1.0, own)) * texelFetch(gathered, ivec2(gl_FragCoord.xy), 0).a : 1.0;
  result = vec4(seen * light.rgb * disc_at(turn_of(at) * (gl_FragCoord.xy - source), light.a, min(length(at), 1.0)), 0);
}`,
};

/** The result; alpha is that of the picture before. */
export const FINISH = `${HEAD}
uniform sampler2D gathered, colour;
in vec2 place;
out vec4 result;
void main() { result = vec4(texture(gathered, place).rgb, texture(colour, place).a); }`;
