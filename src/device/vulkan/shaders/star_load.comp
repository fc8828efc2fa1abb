// The highlights of a tile as complex numbers, dark around it.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Picture { vec4 picture[]; };
layout(std430, binding = 1) writeonly buffer Field { vec2 field[]; };
#include "star.glsl"
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.side * at.side) return;
    const int reach = int(at.reach), tile = int(at.side) - 2 * reach;
    const ivec2 place = ivec2(i % at.side, i / at.side) - reach, pixel = place + ivec2(at.left, at.top);
    const bool inside = all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, ivec2(tile))) &&
                        all(lessThan(pixel, ivec2(at.width, at.height)));
    vec3 light = vec3(0);
    if (inside) light = highlight(usable(picture[pixel.y * int(at.width) + pixel.x].rgb), at.threshold);
    field[i] = at.channels == 0u ? light.rg : vec2(light.b, 0);
}
