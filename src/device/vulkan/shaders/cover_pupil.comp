// Coverage by nearer occluders of each cell of a viewpoint's pupil: 16 x 16 cells a group. The formulas are
// device/cpu/lights/pupil_shadow.cpp's.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Casters { float casters[]; };  // u, v, width, height, blur, coverage
layout(std430, binding = 2) writeonly buffer Covered { float covered[]; };
layout(push_constant) uniform Push { uint views, blocks; } at;  // where these begin in `words`

// A viewpoint: first caster, casters, taps along a side, cells along a tap, signed radius, first cell, first tap.
const uint kViewWords = 7;
const int kChunk = 256;

shared float hit_x[kChunk], hit_y[kChunk], hit_wide[kChunk], hit_tall[kChunk], hit_blur[kChunk],
    hit_coverage[kChunk];

#include "ranks.glsl"

float integral(float x, float middle, float outer, float inner, float peak, float per_ramp) {
    const float t = x - middle, ramp = outer - inner;
    const float up = clamp(t + outer, 0.0, ramp), flat_part = clamp(t + inner, 0.0, 2 * inner),
                down = clamp(t - inner, 0.0, ramp);
    return peak * ((up * up - down * down) * per_ramp + flat_part + down);
}

// Coverage of a cell by a box around `middle`, its edges blurred by another box.
float share(int cell, float middle, float side, float blur) {
    const float outer = 0.5 * (side + blur), inner = 0.5 * abs(side - blur), ramp = outer - inner;
    const float peak = blur > side ? side / blur : 1.0, per_ramp = ramp > 1e-6 ? 0.5 / ramp : 0.0;
    return integral(float(cell + 1), middle, outer, inner, peak, per_ramp) -
           integral(float(cell), middle, outer, inner, peak, per_ramp);
}

void main() {
    const uint own = gl_LocalInvocationIndex, block = at.blocks + 2u * gl_WorkGroupID.x;
    const uint view = at.views + kViewWords * words[block], corner = words[block + 1u];
    const int wide = int(words[view + 2u] * words[view + 3u]);
    const ivec2 low = 16 * ivec2(corner & 0xffffu, corner >> 16), cell = low + ivec2(own % 16u, own / 16u);
    const float per_radius = uintBitsToFloat(words[view + 4u]) * float(words[view + 3u]);
    const float middle = 0.5 * float(wide), cells = abs(per_radius);
    const uint first = words[view], count = words[view + 1u];
    float sum = 0;
    for (uint done = 0u; done < count; done += kChunk) {
        float x = 0, y = 0, wide_by = 0, tall_by = 0, blur = 0;
        const uint i = 6u * (first + done + own);
        bool hits = done + own < count;
        if (hits) {
            x = middle + casters[i] * per_radius, y = middle + casters[i + 1u] * per_radius;
            wide_by = casters[i + 2u] * cells, tall_by = casters[i + 3u] * cells, blur = casters[i + 4u] * cells;
            const float half_x = 0.5 * (wide_by + blur), half_y = 0.5 * (tall_by + blur);
            hits = x + half_x > float(low.x) && x - half_x < float(low.x + 16) && y + half_y > float(low.y) &&
                   y - half_y < float(low.y + 16);
        }
        const uvec2 ranks = ranked(hits);
        const uint rank = ranks.x, all_hits = ranks.y;
        if (hits) {
            hit_x[rank] = x, hit_y[rank] = y, hit_wide[rank] = wide_by, hit_tall[rank] = tall_by;
            hit_blur[rank] = blur, hit_coverage[rank] = casters[i + 5u];
        }
        barrier();
        for (uint k = 0u; k < all_hits; ++k)
            sum += hit_coverage[k] * share(cell.y, hit_y[k], hit_tall[k], hit_blur[k]) *
                   share(cell.x, hit_x[k], hit_wide[k], hit_blur[k]);
    }
    if (cell.x < wide && cell.y < wide) covered[words[view + 5u] + uint(cell.y * wide + cell.x)] = sum;
}
