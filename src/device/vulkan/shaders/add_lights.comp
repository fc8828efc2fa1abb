// The light of lights that are spread by themselves, on 16 x 16 pixels (or cells) of a tile: each with its complete
// kernel, every tap of it dimmed by the share that its viewpoint sees, or by its mask of the pupil.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "laws/tiles.h"
layout(local_size_x = 256) in;
layout(constant_id = 0) const uint kDims = 0;  // 1: a holdout dims what lands in a pixel; 2: lights have masks

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer KernelWords { uint kernels[]; };
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };
layout(std430, binding = 3) readonly buffer Visible { float visible[]; };
layout(std430, binding = 4) readonly buffer Holdout { uint holdout[]; };
layout(std430, binding = 5) writeonly buffer Result { vec4 result[]; };  // by tile, kLightsTile squared pixels each
layout(push_constant) uniform Push {
    uint tiles, order, lights, views;  // where these begin in `words`
    uint records;                      // where records of kernels begin in `kernels`
    uint held_row, held_width, held_samples;
    float stretch;  // of the pupil, vertically
} at;

// A tile: its rectangle, and where its lights begin in the order; the next one says where they end.
// A light: x, y, its light, radius, kernel, 1 + viewpoint (0: nothing is in the way), first tap. Instead of these
// two, a light may have a mask: 8 x 8 points of the pupil's square, row by row from the lowest bit.
const uint kTileWords = 5, kLightWords = 10, kViewWords = 7;
const int kChunk = kGroup;
const uint kTile = kLightsTile, kAcross = kTile / kGroupSide, kGroupsOfTile = kAcross * kAcross;

shared vec4 hit_light[kChunk];
shared int hit_x[kChunk], hit_y[kChunk], hit_tap[kChunk];
shared uint hit_corner[kChunk], hit_size[kChunk], hit_weights[kChunk], hit_view[kChunk];
shared float hit_coc[kChunk];

#include "kernels.glsl"
#include "ranks.glsl"

// The nearest tap of the disc's square stands for those outside.
float seen(uint k, ivec2 pixel) {
    if (hit_view[k] == 0u) return 1;
    const uint view = at.views + kViewWords * (hit_view[k] - 1u);
    const int taps = int(words[view + 2u]);
    const ivec2 tap = clamp(pixel - ivec2(hit_x[k], hit_y[k]) - hit_tap[k], ivec2(0), ivec2(taps - 1));
    return visible[words[view + 6u] + uint(tap.y * taps + tap.x)];
}

// device/cpu/lights/dimmer.cpp: the share of the mask at a place of the pupil's square, between its points.
float through_mask(uint k, ivec2 offset) {
    const uint low = hit_view[k], high = uint(hit_tap[k]);
    if ((low & high) == 0xffffffffu) return 1;
    const float radius = hit_coc[k];
    vec2 place = vec2(offset) / (radius < 0 ? min(radius, -0.5) : max(radius, 0.5));
    place.y /= at.stretch;
    const vec2 p = clamp((place + 1) / 2 * 8 - 0.5, vec2(0), vec2(7));
    const uvec2 c = min(uvec2(p), uvec2(6));
    const vec2 share = p - vec2(c);
    const uint first = (c.y < 4u ? low : high) >> (8u * (c.y & 3u) + c.x),
               second = (c.y < 3u ? low : high) >> (8u * ((c.y + 1u) & 3u) + c.x);
    return mix(mix(float(first & 1u), float(first >> 1 & 1u), share.x),
               mix(float(second & 1u), float(second >> 1 & 1u), share.x), share.y);
}

// engine/waist/holdout.h, for light of one radius.
float let_through(ivec2 pixel, float coc_px) {
    const uint i = uint(pixel.y - int(at.held_row)) * at.held_width + uint(pixel.x);
    float open = 1;
    for (uint s = holdout[i]; s < holdout[i + 1u]; ++s) {
        if (uintBitsToFloat(holdout[at.held_samples + 2u * s]) >= coc_px - 0.02) break;
        open *= 1 - uintBitsToFloat(holdout[at.held_samples + 2u * s + 1u]);
    }
    return open;
}

void main() {
    const uint own = gl_LocalInvocationIndex, part = gl_WorkGroupID.x % kGroupsOfTile;
    const uint tile = at.tiles + kTileWords * (gl_WorkGroupID.x / kGroupsOfTile);
    const ivec2 corner = ivec2(int(words[tile]), int(words[tile + 1u])),
                end = ivec2(int(words[tile + 2u]), int(words[tile + 3u]));
    const ivec2 low = corner + 16 * ivec2(part % 4u, part / 4u), high = min(low + 16, end);
    if (any(greaterThanEqual(low, end))) return;
    const ivec2 pixel = low + ivec2(own % 16u, own / 16u);
    vec4 sum = vec4(0);
    const uint last = words[tile + kTileWords + 4u];
    for (uint first = words[tile + 4u]; first < last; first += kChunk) {
        uint light = 0u, record = 0u;
        bool hits = first + own < last;
        if (hits) {
            light = at.lights + kLightWords * words[at.order + first + own];
            record = at.records + 3u * kernels[words[light + 7u]];
            const ivec2 from = ivec2(int(words[light]), int(words[light + 1u])) + halves(kernels[record]);
            hits = all(lessThan(from, high)) && all(greaterThan(from + halves(kernels[record + 1u]), low));
        }
        const uvec2 ranks = ranked(hits);
        const uint rank = ranks.x, all_hits = ranks.y;
        if (hits) {
            hit_x[rank] = int(words[light]), hit_y[rank] = int(words[light + 1u]);
            hit_light[rank] = vec4(uintBitsToFloat(words[light + 2u]), uintBitsToFloat(words[light + 3u]),
                                   uintBitsToFloat(words[light + 4u]), uintBitsToFloat(words[light + 5u]));
            hit_coc[rank] = uintBitsToFloat(words[light + 6u]);
            hit_view[rank] = words[light + 8u], hit_tap[rank] = int(words[light + 9u]);
            hit_corner[rank] = kernels[record], hit_size[rank] = kernels[record + 1u];
            hit_weights[rank] = kernels[record + 2u];
        }
        barrier();
        for (uint k = 0u; k < all_hits; ++k) {
            const ivec2 d = pixel - ivec2(hit_x[k], hit_y[k]) - halves(hit_corner[k]), wide = halves(hit_size[k]);
            if (any(lessThan(d, ivec2(0))) || any(greaterThanEqual(d, wide))) continue;
            const float held = kDims == 1u && all(lessThan(pixel, high)) ? let_through(pixel, hit_coc[k]) : 1.0;
            const float open = kDims == 2u ? through_mask(k, d + halves(hit_corner[k])) : seen(k, pixel);
            sum += weight(d, wide, hit_weights[k]) * hit_light[k] * (open * held);
        }
        barrier();
    }
    if (any(greaterThanEqual(pixel, high))) return;
    const uvec2 place = uvec2(pixel - corner);
    result[(gl_WorkGroupID.x / kGroupsOfTile * kTile + place.y) * kTile + place.x] = sum;
}
