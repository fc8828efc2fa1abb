// A level of the pyramid from the one below it: averages with weights 1 3 3 1 along each axis.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Fine { vec4 fine[]; };
layout(std430, binding = 1) writeonly buffer Coarse { vec4 coarse[]; };
layout(push_constant) uniform Push { uint width, height; } at;  // of the coarse level
#include "glare.glsl"

const float kWeight[4] = float[4](0.125, 0.375, 0.375, 0.125);

void main() {
    const uint i = invocation();
    if (i >= at.width * at.height) return;
    const int x = int(i % at.width), y = int(i / at.width), width = 2 * int(at.width), height = 2 * int(at.height);
    vec4 sum = vec4(0);
    for (int k = 0; k < 4; ++k) {
        const int column = mirrored(2 * x - 1 + k, width);
        vec4 down = vec4(0);
        for (int j = 0; j < 4; ++j) down += kWeight[j] * fine[mirrored(2 * y - 1 + j, height) * width + column];
        sum += kWeight[k] * down;
    }
    coarse[i] = sum;
}
