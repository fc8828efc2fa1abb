// Highlights on cells of factor x factor pixels, beyond the frame none.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Picture { vec4 picture[]; };
layout(std430, binding = 1) writeonly buffer Cells { vec4 cells[]; };
layout(push_constant) uniform Push { uint width, height, across, down, factor; float threshold; } at;
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.across * at.down) return;
    const uvec2 first = at.factor * uvec2(i % at.across, i / at.across);
    const uvec2 end = min(first + at.factor, uvec2(at.width, at.height));
    vec3 sum = vec3(0);
    for (uint y = first.y; y < end.y; ++y)
        for (uint x = first.x; x < end.x; ++x)
            sum += highlight(usable(picture[y * at.width + x].rgb), at.threshold);
    cells[i] = vec4(sum / float(at.factor * at.factor), 0);
}
