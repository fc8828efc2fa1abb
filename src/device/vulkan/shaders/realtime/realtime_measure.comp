// Measures the brightness of a lamp's surroundings: means over a tile of 16 x 16 pixels; a group is a tile.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(std430, binding = 1) writeonly buffer Surroundings { vec2 surroundings[]; };
#include "realtime.glsl"

shared vec2 sums[64];

void main() {
    const uint own = gl_LocalInvocationIndex;
    const ivec2 first = 2 * ivec2(gl_GlobalInvocationID.xy), last = at.size - 1;
    vec2 sum = vec2(0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 pixel = min(first + ivec2(i & 1, i >> 1), last);
        const float light = brightness(light_of(texelFetch(colours, pixel, 0)));
        sum += vec2(sqrt(light), light);
    }
    sums[own] = sum;
    for (uint half_way = 32u; half_way > 0u; half_way >>= 1) {
        barrier();
        if (own < half_way) sums[own] += sums[own + half_way];
    }
    // The squared mean of roots: surfaces raise it, lamps hardly do.
    if (own == 0u) {
        const vec2 mean = sums[0] / 256;
        surroundings[gl_WorkGroupID.y * uint(at.tiles.x) + gl_WorkGroupID.x] = vec2(mean.x * mean.x, mean.y);
    }
}
