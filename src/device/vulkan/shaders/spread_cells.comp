// The light of pixels, shared between the cells of one blur (engine/waist/cells.h): a cell an invocation, or a group
// where cells are wide.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;
layout(constant_id = 0) const uint kWide = 0;  // 1: a group for each cell

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 2) readonly buffer Values { float values[]; };  // radius, or share of the sharp picture
layout(std430, binding = 3) readonly buffer ExtraOf { uint extra_of[]; };
layout(std430, binding = 4) readonly buffer Extras { vec4 extras[]; };
layout(std430, binding = 5) writeonly buffer Light { vec4 light_of[]; };
layout(std430, binding = 6) writeonly buffer Covered { float covered_of[]; };
#include "mix.glsl"
#include "mix_extras.glsl"

shared vec4 part_light[256];
shared float part_covered[256];

// Of light, in this blur.
float share(Mix mixed, bool near) {
    const uint lower = mixed.lower > 0 ? layer(mixed.lower, near) : layer_count();
    if (at.blur == lower) return 1 - mixed.upper_share;
    return mixed.upper_share > 0 && at.blur == layer(mixed.lower + 1, near) ? mixed.upper_share : 0;
}
void add_extra(uint number, float in_cell, inout vec4 light, inout float covered) {
    const Extra more = extra(number);
    const float part = share(more.mixed, more.near) * in_cell;
    light += part * more.light, covered += part * more.covered;
}
void add_pixel(uint pixel, float in_cell, inout vec4 light, inout float covered) {
    const float value = values[pixel];
    const float part = (at.law == kLayered ? share(own_mix(value), value < 0) : 1) * in_cell;
    light += part * colours[pixel], covered += part;
    const uint more = extras_at(pixel);
    if ((more & kRim) != 0u) add_extra(rim_of(more), in_cell, light, covered);
    if ((more & kHidden) != 0u) add_extra(hidden_of(more), in_cell, light, covered);
}

// Of the light of pixels begin…end-1, in a cell.
int begin_of(int cell, int size) { return cell == 0 ? 0 : cell * size - size / 2; }
int end_of(int cell, int size, int cells) { return (cell + 1) * size + (cell + 1 == cells ? 0 : size / 2); }
vec2 tent(ivec2 pixel, ivec2 cell, float per_cell, ivec2 cells) {
    const vec2 place = clamp((vec2(pixel) + 0.5) * per_cell - 0.5, vec2(0), vec2(cells - 1));
    return max(vec2(0), 1 - abs(place - vec2(cell))) * per_cell;
}

void main() {
    const uint own = gl_LocalInvocationIndex, across = fact(at.blur, 1u), rows = fact(at.blur, 4u);
    const int size = 1 << fact(at.blur, 0u);
    const uint number_of_cell = kWide != 0u ? gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x
                                            : (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + own;
    if (number_of_cell >= across * rows) return;  // for all of a group where it is wide
    const ivec2 cells = ivec2(across, fact(at.blur, 2u));
    const ivec2 cell = ivec2(number_of_cell % across, fact(at.blur, 3u) + number_of_cell / across);
    const ivec2 begin = ivec2(begin_of(cell.x, size), begin_of(cell.y, size));
    const ivec2 end = min(ivec2(end_of(cell.x, size, cells.x), end_of(cell.y, size, cells.y)),
                          ivec2(at.width, at.height));
    const float per_cell = 1 / float(size);
    vec4 light = vec4(0);
    float covered = 0;
    const int step = kWide != 0u ? 256 : 1, first = kWide != 0u ? int(own) : 0, wide = end.x - begin.x;
    for (int i = first; i < wide * (end.y - begin.y); i += step) {
        const ivec2 pixel = begin + ivec2(i % wide, i / wide);
        const uint k = (uint(pixel.y) - at.first_row) * at.width + uint(pixel.x);
        const vec2 in_cell = tent(pixel, cell, per_cell, cells);
        add_pixel(k, in_cell.x * in_cell.y, light, covered);
    }
    if (kWide != 0u) {
        part_light[own] = light, part_covered[own] = covered;
        for (uint half_size = 128u; half_size > 0u; half_size /= 2u) {
            barrier();
            if (own < half_size) {
                part_light[own] += part_light[own + half_size];
                part_covered[own] += part_covered[own + half_size];
            }
        }
        if (own > 0u) return;
        light = part_light[0], covered = part_covered[0];
    }
    light_of[fact(at.blur, 5u) + number_of_cell] = light;
    covered_of[fact(at.blur, 5u) + number_of_cell] = covered;
}
