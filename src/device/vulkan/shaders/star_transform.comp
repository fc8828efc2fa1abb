// One step of the Fourier transforms of all rows, or of all columns: pairs of transforms become transforms of twice
// their length, already in order (T. G. Stockham's way, as in C. Van Loan, Computational Frameworks for the Fast
// Fourier Transform, 1992, 1.7).
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Turns { vec2 turns[]; };  // cos, sin of 2 pi k / side, k < side / 2
layout(std430, binding = 1) readonly buffer In { vec2 from[]; };
layout(std430, binding = 2) writeonly buffer Out { vec2 to[]; };
#include "star.glsl"
#include "glare.glsl"

void main() {
    const uint i = invocation(), half_side = at.side / 2u;
    if (i >= at.side * half_side) return;
    // Neighbours in memory are done side by side.
    const bool rows = at.stride == 1u;
    const uint line = rows ? i / half_side : i % at.side, k = rows ? i % half_side : i / at.side;
    const uint first = line * at.across, within = k % at.half_length;
    const vec2 turn = turns[within * (half_side / at.half_length)] * vec2(1, at.sign);
    const vec2 a = from[first + k * at.stride], b = from[first + (k + half_side) * at.stride];
    const vec2 turned = vec2(b.x * turn.x - b.y * turn.y, b.x * turn.y + b.y * turn.x);
    const uint place = first + (2u * k - within) * at.stride;
    to[place] = a + turned;
    to[place + at.half_length * at.stride] = a - turned;
}
