// Blurs the cells of one blur along one axis; after the second, what lies inside the picture counts for all.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer LightIn { vec4 light_in[]; };
layout(std430, binding = 2) readonly buffer CoveredIn { float covered_in[]; };
layout(std430, binding = 3) writeonly buffer LightOut { vec4 light_out[]; };
layout(std430, binding = 4) writeonly buffer CoveredOut { float covered_out[]; };
#include "mix.glsl"

void main() {
    const uint across = fact(at.blur, 1u), rows = fact(at.blur, 4u), first = fact(at.blur, 5u);
    const uint i = (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + gl_LocalInvocationIndex;
    if (i >= across * rows) return;
    const bool along_x = at.axis == 0u;
    const uint weights = fact(at.blur, along_x ? 6u : 9u);
    const int radius = int(fact(at.blur, along_x ? 7u : 10u));
    const int x = int(i % across), y = int(i / across);
    const int place = along_x ? x : y, cells = int(along_x ? across : rows), stride = along_x ? 1 : int(across);
    vec4 light = vec4(0);
    float covered = 0;
    for (int k = max(-radius, -place); k <= min(radius, cells - 1 - place); ++k) {
        const float w = number(weights + uint(k + radius));
        const uint from = first + uint(int(i) + k * stride);
        light += w * light_in[from];
        covered += w * covered_in[from];
    }
    if (!along_x) {
        const float scale =
            1 / (number(fact(at.blur, 8u) + uint(x)) * number(fact(at.blur, 11u) + fact(at.blur, 3u) + uint(y)));
        light *= scale, covered *= scale;
    }
    light_out[first + i] = light;
    covered_out[first + i] = covered;
}
