// The light of pixels, shared down their columns between the rows of one blur's cells: a column of pixels in a row of
// cells an invocation. spread_cells.comp shares it along the rows; on level 0, where cells are pixels, this is all.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 2) readonly buffer Values { float values[]; };  // radius, or share of the sharp picture
layout(std430, binding = 3) readonly buffer ExtraOf { uint extra_of[]; };
layout(std430, binding = 4) readonly buffer Extras { vec4 extras[]; };
layout(std430, binding = 5) writeonly buffer Light { vec4 light_of[]; };
layout(std430, binding = 6) writeonly buffer Covered { float covered_of[]; };
#include "mix.glsl"
#include "mix_extras.glsl"

// Share of the light in this blur.
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

void main() {
    const uint i = (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + gl_LocalInvocationIndex;
    if (i >= at.width * fact(at.blur, 4u)) return;
    const int level = int(fact(at.blur, 0u)), cells = int(fact(at.blur, 2u));
    const int x = int(i % at.width), cell = int(fact(at.blur, 3u) + i / at.width);
    vec4 light = vec4(0);
    float covered = 0;
    const Span rows = pixels_of(cell, level, int(at.height));
    for (int y = rows.begin; y < rows.end; ++y)
        add_pixel((uint(y) - at.first_row) * at.width + uint(x), spline_share(y, cell, level, cells), light, covered);
    const uint to = level > 0 ? i : fact(at.blur, 5u) + i;
    light_of[to] = light;
    covered_of[to] = covered;
}
