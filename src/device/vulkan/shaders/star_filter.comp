// Two real pictures in one transform, each times its kernel's: device/cpu/glare/convolve.cpp's filter_pair().
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Real { float kernel_a[]; };
layout(std430, binding = 1) readonly buffer Imaginary { float kernel_b[]; };
layout(std430, binding = 2) readonly buffer In { vec2 from[]; };
layout(std430, binding = 3) writeonly buffer Out { vec2 to[]; };
#include "star.glsl"
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.side * at.side) return;
    const uint x = i % at.side, y = i / at.side;
    const uint opposite = (at.side - y) % at.side * at.side + (at.side - x) % at.side;
    const float a = kernel_a[i], b = kernel_b[i];
    to[i] = 0.5 * ((a + b) * from[i] + (a - b) * vec2(from[opposite].x, -from[opposite].y));
}
