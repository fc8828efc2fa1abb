// Cells as pixels, between their middles.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Cells { vec4 cells[]; };
layout(std430, binding = 1) buffer Star { vec4 star[]; };
layout(push_constant) uniform Push { uint width, height, across, down, factor, adds; } at;
#include "glare.glsl"

vec4 cell(ivec2 at_cell) {
    const ivec2 c = clamp(at_cell, ivec2(0), ivec2(at.across, at.down) - 1);
    return cells[c.y * int(at.across) + c.x];
}

void main() {
    const uint i = invocation();
    if (i >= at.width * at.height) return;
    const vec2 place = (vec2(i % at.width, i / at.width) + 0.5) / float(at.factor) - 0.5;
    const ivec2 low = ivec2(floor(place));
    const vec2 s = place - vec2(low);
    const vec4 light = (1 - s.y) * ((1 - s.x) * cell(low) + s.x * cell(low + ivec2(1, 0))) +
                       s.y * ((1 - s.x) * cell(low + ivec2(0, 1)) + s.x * cell(low + ivec2(1, 1)));
    star[i] = at.adds != 0u ? star[i] + light : light;
}
