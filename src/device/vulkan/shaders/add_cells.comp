// Pixels of a tile from the cells of its levels: between the cells of coarser ones bilinear, which keeps their light.
// kGroupSide squared pixels a group.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "laws/tiles.h"
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Cells { vec4 cells[]; };          // by block, kStampedBlock squared cells each
layout(std430, binding = 2) writeonly buffer Result { vec4 result[]; };  // by tile, kStampedTile squared pixels each
layout(push_constant) uniform Push { uint tiles, levels; } at;  // where these begin in `words`

// A tile: its rectangle, its first level; the next one's ends them. A level: its number, its first cell, blocks
// across, the first block.
const uint kTileWords = 5u, kLevelWords = 5u;
const int kSide = kStampedBlock;

vec4 cell(uint level, ivec2 place) {
    const ivec2 d = place - ivec2(int(words[level + 1u]), int(words[level + 2u]));
    const uint block = words[level + 4u] + uint(d.y / kSide) * words[level + 3u] + uint(d.x / kSide);
    return cells[(block * kSide + uint(d.y % kSide)) * kSide + uint(d.x % kSide)];
}

void main() {
    const uint own = gl_LocalInvocationIndex, part = gl_WorkGroupID.x;
    const uint tile = at.tiles + kTileWords * gl_WorkGroupID.y;
    const ivec2 low = ivec2(int(words[tile]), int(words[tile + 1u])),
                high = ivec2(int(words[tile + 2u]), int(words[tile + 3u]));
    const uint across = kStampedTile / kGroupSide;
    const ivec2 d = kGroupSide * ivec2(part % across, part / across) + ivec2(own % kGroupSide, own / kGroupSide);
    const ivec2 pixel = low + d;
    if (any(greaterThanEqual(pixel, high))) return;
    vec4 sum = vec4(0);
    for (uint l = words[tile + 4u]; l < words[tile + kTileWords + 4u]; ++l) {
        const uint level = at.levels + kLevelWords * l;
        if (words[level] == 0u) {
            sum += cell(level, pixel);
            continue;
        }
        const float per_cell = 1 / float(1u << words[level]);
        const vec2 place = (vec2(pixel) + 0.5) * per_cell - 0.5;
        const ivec2 first = ivec2(floor(place));
        const vec2 share = place - vec2(first);
        sum += per_cell * per_cell *
               mix(mix(cell(level, first), cell(level, first + ivec2(1, 0)), share.x),
                   mix(cell(level, first + ivec2(0, 1)), cell(level, first + 1), share.x), share.y);
    }
    result[(gl_WorkGroupID.y * kStampedTile + uint(d.y)) * kStampedTile + uint(d.x)] = sum;
}
