// Shares the columns made by spread_columns.comp along the rows between the cells of one blur.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer LightIn { vec4 light_in[]; };
layout(std430, binding = 2) readonly buffer CoveredIn { float covered_in[]; };
layout(std430, binding = 3) writeonly buffer Light { vec4 light_of[]; };
layout(std430, binding = 4) writeonly buffer Covered { float covered_of[]; };
#include "mix.glsl"

void main() {
    const uint across = fact(at.blur, 1u), rows = fact(at.blur, 4u);
    const uint i = (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + gl_LocalInvocationIndex;
    if (i >= across * rows) return;
    const int level = int(fact(at.blur, 0u)), cell = int(i % across);
    vec4 light = vec4(0);
    float covered = 0;
    const Span columns = pixels_of(cell, level, int(at.width));
    for (int x = columns.begin; x < columns.end; ++x) {
        const float share = spline_share(x, cell, level, int(across));
        const uint from = i / across * at.width + uint(x);
        light += share * light_in[from], covered += share * covered_in[from];
    }
    light_of[fact(at.blur, 5u) + i] = light;
    covered_of[fact(at.blur, 5u) + i] = covered;
}
