// Combines the sectors of the pupil for each pixel of a tile. Discrete sources leave a little of the lens
// free; it goes to those that arrived.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "laws/compositing.h"
#include "laws/tiles.h"
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer PlanWords { uint plan[]; };
layout(std430, binding = 1) readonly buffer Light { vec4 light_of[]; };
layout(std430, binding = 2) readonly buffer Taken { float taken_of[]; };
layout(std430, binding = 3) writeonly buffer Result { vec4 result[]; };  // by tile, kScatterTile squared pixels each
layout(push_constant) uniform Push { uint tiles; } at;

const uint kTileWords = 8, kSide = kScatterTile, kTilePixels = kSide * kSide;

void main() {
    const uint tile = at.tiles + kTileWords * (gl_GlobalInvocationID.x / kTilePixels);
    const uint pixel = gl_GlobalInvocationID.x % kTilePixels;
    if (pixel % kSide >= plan[tile + 2u] - plan[tile] || pixel / kSide >= plan[tile + 3u] - plan[tile + 1u])
        return;
    vec4 light = vec4(0);
    float taken = 0;
    for (uint sector = 0u; sector < plan[tile + 5u]; ++sector) {
        const uint place = plan[tile + 6u] + sector * kTilePixels + pixel;
        light += light_of[place];
        taken += taken_of[place];
    }
    vec4 made = taken > 0 ? light * (1 / taken) : vec4(0);
    if (abs(made.a - 1) < kOpaqueRounding) made.a = 1;
    result[gl_GlobalInvocationID.x] = made;
}
