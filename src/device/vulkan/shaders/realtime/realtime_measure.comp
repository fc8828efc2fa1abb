// Measures the brightness of a lamp's surroundings: means over a tile of 16 x 16 pixels; a group is a tile.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(std430, binding = 1) writeonly buffer Surroundings { vec2 surroundings[]; };
#include "realtime.glsl"

shared vec2 sums[64];

float brightness_at(ivec2 pixel) {
    const vec3 light = clamp(texelFetch(colours, pixel, 0).rgb, vec3(0), vec3(kMostLight));
    return light.r + light.g + light.b;
}

void main() {
    const uint own = gl_LocalInvocationIndex;
    const ivec2 last = at.size - 1, first = min(2 * ivec2(gl_GlobalInvocationID.xy), last), second = min(2 * ivec2(gl_GlobalInvocationID.xy) + 1, last);
    const vec4 light = vec4(brightness_at(first), brightness_at(ivec2(second.x, first.y)), brightness_at(ivec2(first.x, second.y)), brightness_at(second));
    const vec4 roots = sqrt(light);
    sums[own] = vec2(roots.x + roots.y + roots.z + roots.w, light.x + light.y + light.z + light.w);
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
