// Gathers one cell: what is in focus and behind over the cell's own radius, what is in front of focus over all that
// reaches its tile.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray cells;
layout(std430, binding = 1) readonly buffer Lens { vec4 lens[]; };  // engine/gather/realtime_plan.h
layout(std430, binding = 2) readonly buffer Tiles { vec2 tiles[]; };
layout(std430, binding = 3) readonly buffer Reach { float reach[]; };
layout(binding = 4, rgba16f) writeonly uniform image2DArray gathered;
#include "realtime.glsl"

const int kTaps = 127, kNorms = 64, kSide = 64, kFirstNorm = kTaps, kNearShape = kFirstNorm + kNorms,
          kFarShape = kNearShape + kSide * kSide;
const float kShapeHalf = 1.25;  // of the pupil's radius: half a side of the shape
const float kTapsAcross = 6.5;  // between the middle and the rim
const float kLeastArea = 1e-4;

// engine/gather/realtime_plan.cpp: what a tap counts of something blurred by a share of the disc's radius.
vec4 shape(int first, vec2 tap, float share) {
    const vec2 u = -tap / share;
    const ivec2 i = ivec2(floor((u / kShapeHalf * 0.5 + 0.5) * float(kSide)));
    const bool is_inside = all(greaterThanEqual(i, ivec2(0))) && all(lessThan(i, ivec2(kSide)));
    const vec4 own = is_inside ? lens[first + i.y * kSide + i.x] : vec4(0);
    return mix(vec4(dot(u, u) <= 1 ? 1 : 0), own, smoothstep(0.15, 0.35, share));
}
vec2 norm(float share) {
    const float place = clamp(share, 0.0, 1.0) * float(kNorms - 1);
    const int i = min(int(place), kNorms - 2);
    return mix(lens[kFirstNorm + i].xy, lens[kFirstNorm + i + 1].xy, place - float(i));
}
// Where a tap over a disc of this radius reads.
vec3 place_of(vec2 middle, vec2 tap, float radius_px, int layer) {
    return vec3((middle + 0.5 * radius_px * vec2(tap.x, tap.y * at.aspect)) / vec2(8 * at.tiles), layer);
}
float level_of(float radius_px) { return max(0.0, log2(radius_px / (2 * kTapsAcross))); }

vec4 back_of(vec2 middle, vec4 own_light, vec2 own, float hides_px, out float is_known) {
    const bool has = own.x > 0.02;
    const float own_px = has ? own.y / own.x : 0.0, radius = has ? max(own_px, 1.0) : hides_px;
    is_known = 1;
    if (has && own_px < 0.5) return own_light / own.x;
    const float level = level_of(radius);
    vec4 light = vec4(0);
    float area = 0;
    for (int i = 0; i < kTaps; ++i) {
        const vec2 tap = lens[i].xy;
        const vec2 there = textureLod(cells, place_of(middle, tap, radius, kBack), level).xy;
        if (there.x < kLeastArea) continue;
        // What lies behind is seen through this cell's own disc; what hides is guessed from all around it.
        const float share = has ? clamp(there.y / there.x, 0.5, radius) / radius : 1.0;
        const vec4 there_light = textureLod(cells, place_of(middle, tap, radius, kBackLight), level);
        const vec4 w = has ? norm(share).y * shape(kFarShape, tap, share)
                           : vec4(1 - 0.9 * lens[i].z);
        light += w * there_light;
        area += w.a * there.x;
    }
    if (area > 1e-3) return light / area;
    is_known = has ? 1.0 : 0.0;
    return has ? own_light / own.x : vec4(0);
}

vec4 near_of(vec2 middle, float radius, out float area) {
    const float level = level_of(radius);
    vec4 light = vec4(0);
    area = 0;
    for (int i = 0; i < kTaps; ++i) {
        const vec2 tap = lens[i].xy;
        const vec2 there = textureLod(cells, place_of(middle, tap, radius, kNear), level).xy;
        if (there.x < kLeastArea) continue;
        const float share = clamp(there.y / there.x, 0.5, radius) / radius;
        const vec4 w = norm(share).x * shape(kNearShape, tap, share);
        light += w * textureLod(cells, place_of(middle, tap, radius, kNearLight), level);
        area += w.a * there.x;
    }
    return light;
}

void main() {
    const ivec2 cell = ivec2(gl_GlobalInvocationID.xy), tile = ivec2(gl_WorkGroupID.xy);
    const float near_px = reach[tile.y * at.tiles.x + tile.x];
    const vec2 middle = vec2(cell) + 0.5, own = texelFetch(cells, ivec3(cell, kBack), 0).xy;
    const vec4 own_light = texelFetch(cells, ivec3(cell, kBackLight), 0);
    float is_known, area = 0;
    const vec4 back = back_of(middle, own_light, own, max(near_px, 1.0), is_known);
    vec4 near = vec4(0);
    if (near_px > 0.5) near = near_of(middle, max(near_px, 1.0), area);
    imageStore(gathered, ivec3(cell, kGatheredBack), back);
    imageStore(gathered, ivec3(cell, kGatheredNear), near);
    const float own_px = own.x > 0.02 ? own.y / own.x : 0.0;
    imageStore(gathered, ivec3(cell, kGatheredArea), vec4(area, own_px, is_known, own.x));
}
