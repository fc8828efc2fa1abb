// Shared by the dispatches of the real-time pass (docs/explain/real-time.md).
layout(push_constant) uniform Push {
    ivec2 size, tiles;          // pixels; tiles of 16 x 16 of them
    float add_px, per_depth_px;  // a signed radius is add_px + per_depth_px * depth
    float most_px, aspect;       // radii are cut there; vertical ones are `aspect` times as large
    uint has_layer;
    float exposure;  // of the host's display
    vec2 zone_scale, zone_add;  // share of the way from the first zone of the lens to the last: scale * pixel + add
    uint view;  // what is drawn: petzval/vulkan.h
} at;

// The lens as fours of floats: number of taps, their side, columns and rows of zones; taps; then the weights of each zone and
// its kernels of lamps.
const int kSpirals = 4, kGridTaps = 72, kShares = 64, kOfLamps = 67800;
int all_taps_of(vec4 head) { return kSpirals * int(head.x) + kGridTaps; }
int first_zone_of(vec4 head) { return 1 + all_taps_of(head); }
int size_of_zone(vec4 head) { return 2 * kShares * all_taps_of(head) + kOfLamps; }
// Place in the grid of zones, from its first node.
vec2 zone_place(vec2 pixel, vec2 zones) { return clamp(at.zone_scale * pixel + at.zone_add, vec2(0), vec2(1)) * (zones - 1); }

const float kMostLight = 60000;  // that cells hold
const int kTile = 16;            // pixels
const int kShadowSteps = 6;      // on the way of a lamp's light to a pixel
const float kShadowStep = 1 / float(kShadowSteps);
const int kLayers = 4, kBackLight = 0, kBack = 1, kNearLight = 2, kNear = 3;  // of cells
// Stored for the finest level only: signed radii of the cell's four pixels.
const int kRadii = 4;
const int kGatheredBack = 0, kGatheredNear = 1, kGatheredArea = 2;            // of what is gathered

// The lamp of a cell, kept in halves in a buffer: its light is a factor, a power of two, times `light`.
struct CellLamp {
    vec3 light;
    float factor;
    vec2 place;  // from the cell's corner, pixels
    float radius;  // signed
};
// Index of a cell's lamp in the buffer: the cells of a tile follow each other.
int lamp_at(ivec2 cell) {
    const ivec2 tile = cell >> 3, inner = cell & 7;
    return 64 * (tile.y * at.tiles.x + tile.x) + 8 * inner.y + inner.x;
}
uvec4 packed_lamp(CellLamp lamp) {
    return uvec4(packHalf2x16(lamp.light.rg), packHalf2x16(vec2(lamp.light.b, lamp.factor)), packHalf2x16(lamp.place), floatBitsToUint(lamp.radius));
}
CellLamp unpacked_lamp(uvec4 kept) {
    const vec2 rest = unpackHalf2x16(kept.y);
    return CellLamp(vec3(unpackHalf2x16(kept.x), rest.x), rest.y, unpackHalf2x16(kept.z), uintBitsToFloat(kept.w));
}

vec4 light_of(vec4 colour) { return clamp(colour, vec4(0), vec4(kMostLight)); }
// The colour if it is finite: a host's picture may hold infinity, which would spread. A sum is finite if its parts are.
vec4 finite_of(vec4 colour) {
    const float all = abs(colour.r) + abs(colour.g) + abs(colour.b) + abs(colour.a);
    if ((floatBitsToUint(all) & 0x7fffffffu) < 0x7f800000u) return colour;
    const uvec4 bits = floatBitsToUint(colour) & 0x7fffffffu;
    return mix(clamp(colour, vec4(-kMostLight), vec4(kMostLight)), vec4(0), greaterThan(bits, uvec4(0x7f800000u)));
}
float brightness(vec4 light) { return light.r + light.g + light.b; }
float radius_of(float depth) {
    const float radius = at.add_px + at.per_depth_px * depth;
    return radius == radius ? clamp(radius, -at.most_px, at.most_px) : 0.0;
}
// The last bits of a stored radius mark pixels that show two surfaces and have the background's depth: a silhouette pixel that
// has the near surface's radius, or a rim pixel (realtime_rims.glsl).
const uint kSilhouette = 1u, kRimPixel = 2u;
float with_mark(float radius, uint mark) { return unpackHalf2x16(packHalf2x16(vec2(radius, 0)) & ~3u | mark).x; }
uint mark_of(float stored) { return packHalf2x16(vec2(stored, 0)) & 3u; }
// smoothstep() between two constants, without its division.
float ramp(float from, float to, float x) {
    const float part = clamp(x * (1 / (to - from)) - from / (to - from), 0.0, 1.0);
    return part * part * (3 - 2 * part);
}
const float kSharpPx = 0.38;  // discs up to this radius reach no pixel but their own (realtime_combine.glsl: disc_of)
// The share of light at this radius that cells draw; the rest is blurred pixel by pixel.
const float kWholePx = 3.5;  // from there on they draw all
float blurred_share(float radius_px) { return ramp(2.0, kWholePx, radius_px); }
// The radius that cells gather over: with the blur of the cells themselves (boxes and tents of two pixels)
// the disc has the right second moment.
float gathered_radius(float radius_px) { return sqrt(max(radius_px * radius_px - 4, 1.0)); }
// The last place among cells of this size that may be read: a frame smaller than the images has cells around it only as far
// as discs reach (pass.cpp: record_steps).
vec2 farthest_place(vec2 texel) { return 0.5 * texel * (vec2(at.size) + at.most_px * vec2(1, at.aspect)); }

// Weights of the two ends of a line through hidden background, at these distances in pixels. likely: 0 for an end that was not
// found. Alike and close ends count most.
vec2 weights_of(vec4 one, vec4 other, vec2 away, vec2 likely) {
    const float both = likely.x * likely.y, across = away.x + away.y;
    if (both == 0) return 1e-3 * likely * likely / max(away * away, vec2(1));
    const vec4 apart = one - other;
    const float differ = dot(apart, apart) / (dot(one, one) + dot(other, other) + 1e-6);
    return away.yx * both / (across * across * across * (0.01 + differ));
}
