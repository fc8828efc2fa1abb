// Gathers one cell: what is in focus and behind over the cell's own radius, what is in front of focus over all that
// reaches its tile.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray cells;
layout(std430, binding = 1) readonly buffer Lens { vec4 lens[]; };  // engine/gather/realtime_plan.h
layout(std430, binding = 2) readonly buffer Reach { vec2 reach[]; };
layout(binding = 3, rgba16f) writeonly uniform image2DArray gathered;
#include "realtime.glsl"

const int kTaps = 127, kNorms = 64, kSide = 64, kFirstNorm = kTaps, kNearShape = kFirstNorm + kNorms,
          kFarShape = kNearShape + kSide * kSide;
const float kShapeHalf = 1.25;  // of the pupil's radius: half a side of the shape
const float kTapsAcross = 6.5;  // between the middle and the rim
const float kLeastArea = 1e-4;
const float kNearestPx = 8;  // where what is hidden is looked for first

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
// Read position of a tap over a disc of this radius.
vec3 place_of(vec2 middle, vec2 tap, float radius_px, int layer) {
    return vec3((middle + 0.5 * radius_px * vec2(tap.x, tap.y * at.aspect)) / vec2(8 * at.tiles), layer);
}
float level_of(float radius_px) { return max(0.0, log2(radius_px / (2 * kTapsAcross))); }

// Adds what a tap says of something hidden: bright things hide behind nothing, as far as is known.
void guess(vec4 there, float there_area, float weight, inout vec4 light, inout float area) {
    const float likely = weight / (1 + brightness(there) / there_area);
    light += likely * there, area += likely * there_area;
}

// Background of a cell completely in front of focus: the mean of the light behind focus around it, and of far
// less blurred near light; of the nearest of these.
vec4 hidden_of(vec2 middle, float own_px, float most_px, out float is_known) {
    vec4 light = vec4(0);
    float area = 0;
    for (float radius = min(kNearestPx, most_px);; radius = min(4 * radius, most_px)) {
        const float level = level_of(radius);
        for (int i = 0; i < kTaps; ++i) {
            const vec2 tap = lens[i].xy;
            const float w = exp2(-8 * lens[i].z * lens[i].z);
            const vec3 back = textureLod(cells, place_of(middle, tap, radius, kBack), level).xyz;
            if (back.z > kLeastArea)
                guess(textureLod(cells, place_of(middle, tap, radius, kBackLight), level) * (back.z / back.x), back.z, w,
                      light, area);
            const vec2 near = textureLod(cells, place_of(middle, tap, radius, kNear), level).xy;
            const float behind = near.x > kLeastArea ? w * smoothstep(0.8, 0.6, near.y / (near.x * own_px)) : 0.0;
            if (behind > 0)
                guess(textureLod(cells, place_of(middle, tap, radius, kNearLight), level), near.x, behind, light, area);
        }
        if (area > 0.05 || radius == most_px) break;
    }
    is_known = area > 1e-6 ? 1.0 : 0.0;
    return area > 1e-6 ? light / area : vec4(0);
}

// Mean radius of the light behind focus in a cell.
float back_radius(vec4 back) { return back.y / max(back.w, 1e-7); }

// Sums taps over a disc: light about as blurred as a cell of `own_px`, or else far less blurred light; and
// the largest radius of the latter.
const float kLessBlurred = 0.4, kAsBlurred = 0.7;  // of the cell's radius
vec4 back_over(vec2 middle, float radius, float own_px, bool is_less, out float less_px, out float area) {
    const float level = level_of(radius);
    vec4 light = vec4(0);
    area = less_px = 0;
    for (int i = 0; i < kTaps; ++i) {
        const vec2 tap = lens[i].xy;
        const vec4 there = textureLod(cells, place_of(middle, tap, radius, kBack), level);
        if (there.x == 0) continue;
        const float reaches = back_radius(there), alike = smoothstep(kLessBlurred, kAsBlurred, reaches / own_px);
        if (alike < 1 && there.x > 0.01) less_px = max(less_px, reaches);
        const float share = clamp(reaches, 0.5, radius) / radius;
        const vec4 w = (is_less ? 1 - alike : alike) * norm(share).y * shape(kFarShape, tap, share);
        if (w.a == 0) continue;
        light += w * textureLod(cells, place_of(middle, tap, radius, kBackLight), level);
        area += w.a * there.x;
    }
    return light;
}
// Blurs a cell with content: background is seen through this cell's own disc. Far less blurred light has only
// a few taps in that disc: it is gathered again, over its own reach, and lies on top.
vec4 back_of(vec2 middle, vec4 own_light, vec4 own) {
    const float own_px = back_radius(own), radius = max(own_px, 1.0);
    if (own_px < 0.5) return own_light / own.x;
    float less_px, area, none, on_top;
    vec4 light = back_over(middle, radius, radius, false, less_px, area);
    light = area > 0 ? light / area : own_light / own.x;
    if (less_px > 0) {
        const vec4 top = back_over(middle, max(less_px, 1.0), radius, true, none, on_top);
        light = on_top < 1 ? top + (1 - on_top) * light : top / on_top;
    }
    return light;
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
    const float near_px = reach[tile.y * at.tiles.x + tile.x].x;
    const vec2 middle = vec2(cell) + 0.5;
    const vec4 own = texelFetch(cells, ivec3(cell, kBack), 0);
    const bool has = own.z > 0.02;
    float is_known = 1, area = 0;
    vec4 back;
    if (has) {
        back = back_of(middle, texelFetch(cells, ivec3(cell, kBackLight), 0), own);
    } else {
        const vec2 own_near = texelFetch(cells, ivec3(cell, kNear), 0).xy;
        back = hidden_of(middle, own_near.y / own_near.x, max(near_px, 1.0), is_known);
    }
    vec4 near = vec4(0);
    if (near_px > 0.5) near = near_of(middle, max(near_px, 1.0), area);
    imageStore(gathered, ivec3(cell, kGatheredBack), back);
    imageStore(gathered, ivec3(cell, kGatheredNear), near);
    const float own_px = has ? back_radius(own) : 0.0;
    imageStore(gathered, ivec3(cell, kGatheredArea), vec4(area, own_px, is_known, own.x));
}
