// A level blurred along one axis.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Weights { float weights[]; };
layout(std430, binding = 1) readonly buffer In { vec4 light[]; };
layout(std430, binding = 2) buffer Out { vec4 blurred[]; };
layout(push_constant) uniform Push {
    uint width, height;
    uint down;    // 0: along x, 1: along y
    uint first;   // weight
    uint radius;
    float share;  // of the result that is given
    uint adds;    // 0: what was there goes
} at;
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.width * at.height) return;
    const int x = int(i % at.width), y = int(i / at.width), width = int(at.width), height = int(at.height);
    const int radius = int(at.radius);
    vec4 sum = vec4(0);
    for (int k = -radius; k <= radius; ++k) {
        const int from = at.down != 0u ? mirrored(y + k, height) * width + x : y * width + mirrored(x + k, width);
        sum += weights[at.first + uint(k + radius)] * light[from];
    }
    blurred[i] = at.adds != 0u ? blurred[i] + at.share * sum : at.share * sum;
}
