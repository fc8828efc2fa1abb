// Adds a level to the one below it, interpolated with weights 1 3 3 1.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Coarse { vec4 coarse[]; };
layout(std430, binding = 1) buffer Fine { vec4 fine[]; };
layout(push_constant) uniform Push { uint width, height, adds; } at;  // of the fine level; 0: what was there goes
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.width * at.height) return;
    const int x = int(i % at.width), y = int(i / at.width), width = int(at.width) / 2, height = int(at.height) / 2;
    const int column = x / 2, other = mirrored(x % 2 == 1 ? column + 1 : column - 1, width);
    const int near = y / 2 * width, far = mirrored(y % 2 == 1 ? y / 2 + 1 : y / 2 - 1, height) * width;
    const vec4 light = 0.5625 * coarse[near + column] + 0.1875 * (coarse[near + other] + coarse[far + column]) +
                       0.0625 * coarse[far + other];
    fine[i] = at.adds != 0u ? fine[i] + light : light;
}
