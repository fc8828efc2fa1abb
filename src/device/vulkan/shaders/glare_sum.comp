// Sums of a picture's light: each group that of every n-th pixel, in one order.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Picture { vec4 picture[]; };
layout(std430, binding = 1) writeonly buffer Sums { vec4 sums[]; };
layout(push_constant) uniform Push { uint count; } at;
#include "glare.glsl"

shared vec3 sum_of[256];

void main() {
    vec3 sum = vec3(0);
    for (uint i = gl_GlobalInvocationID.x; i < at.count; i += gl_NumWorkGroups.x * 256u)
        sum += usable(picture[i].rgb);
    sum_of[gl_LocalInvocationIndex] = sum;
    for (uint half_of = 128u; half_of > 0u; half_of /= 2u) {
        barrier();
        if (gl_LocalInvocationIndex < half_of)
            sum_of[gl_LocalInvocationIndex] += sum_of[gl_LocalInvocationIndex + half_of];
    }
    if (gl_LocalInvocationIndex == 0u) sums[gl_WorkGroupID.x] = vec4(sum_of[0], 0);
}
