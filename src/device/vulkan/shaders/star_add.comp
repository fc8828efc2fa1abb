// Adds the light of a tile to the star's light inside the picture. Light is not negative.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Field { vec2 field[]; };
layout(std430, binding = 1) buffer Star { vec4 star[]; };
#include "star.glsl"
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.width * at.height) return;
    const ivec2 place = ivec2(i % at.width, i / at.width) - ivec2(at.left, at.top) + int(at.reach);
    vec2 light = vec2(0);
    if (all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, ivec2(at.side))))
        light = max(field[place.y * int(at.side) + place.x], vec2(0)) / (float(at.side) * float(at.side));
    const vec4 given = at.channels == 0u ? vec4(light, 0, 0) : vec4(0, 0, light.x, 0);
    star[i] = at.adds != 0u ? star[i] + given : given;
}
