// The light that bloom is made of: the picture's, its sides grown by the mirror image.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Picture { vec4 picture[]; };
layout(std430, binding = 1) writeonly buffer Light { vec4 light[]; };
layout(push_constant) uniform Push { uint width, height, padded_width, padded_height; float threshold; } at;
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.padded_width * at.padded_height) return;
    const int x = mirrored(int(i % at.padded_width), int(at.width)),
              y = mirrored(int(i / at.padded_width), int(at.height));
    light[i] = vec4(highlight(usable(picture[y * int(at.width) + x].rgb), at.threshold), 0);
}
