// One pass of a streak: the cells moved along the spike, ever weaker. Nothing comes from beyond the frame.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Taps { uint taps[]; };
layout(std430, binding = 1) readonly buffer In { vec4 light[]; };
layout(std430, binding = 2) buffer Out { vec4 streak[]; };
layout(push_constant) uniform Push {
    uint width, height;
    uint first, end;  // words of the taps: dx, dy, red, green, blue
    float share;      // of the result that is given
    uint adds;        // 0: what was there goes
} at;
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.width * at.height) return;
    const int x = int(i % at.width), y = int(i / at.width), width = int(at.width), height = int(at.height);
    vec3 sum = vec3(0);
    for (uint tap = at.first; tap < at.end; tap += 5u) {
        const int u = x + int(taps[tap]), v = y + int(taps[tap + 1u]);
        if (u < 0 || u >= width || v < 0 || v >= height) continue;
        const vec3 weight = vec3(uintBitsToFloat(taps[tap + 2u]), uintBitsToFloat(taps[tap + 3u]),
                                 uintBitsToFloat(taps[tap + 4u]));
        sum += weight * light[v * width + u].rgb;
    }
    const vec4 given = vec4(at.share * sum, 0);
    streak[i] = at.adds != 0u ? streak[i] + given : given;
}
