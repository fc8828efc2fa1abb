// Pixels of a tile from the cells of its levels: between the cells of coarser ones bilinear, which keeps their light.
// 16 x 16 pixels a group, 256 groups a tile.
#version 450
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Cells { vec4 cells[]; };          // by block, 64 x 64 cells each
layout(std430, binding = 2) writeonly buffer Result { vec4 result[]; };  // by tile, 256 x 256 pixels each
layout(push_constant) uniform Push { uint tiles, levels; } at;  // where these begin in `words`

// A tile: its rectangle, its first level; the next one's ends them. A level: its number, its first cell, blocks
// across, the first block.
const uint kTileWords = 5u, kLevelWords = 5u;

vec4 cell(uint level, ivec2 place) {
    const ivec2 d = place - ivec2(int(words[level + 1u]), int(words[level + 2u]));
    const uint block = words[level + 4u] + uint(d.y / 64) * words[level + 3u] + uint(d.x / 64);
    return cells[block * 4096u + uint(d.y % 64) * 64u + uint(d.x % 64)];
}

void main() {
    const uint own = gl_LocalInvocationIndex, part = gl_WorkGroupID.x;
    const uint tile = at.tiles + kTileWords * gl_WorkGroupID.y;
    const ivec2 low = ivec2(int(words[tile]), int(words[tile + 1u])),
                high = ivec2(int(words[tile + 2u]), int(words[tile + 3u]));
    const ivec2 d = ivec2(16u * (part % 16u) + own % 16u, 16u * (part / 16u) + own / 16u), pixel = low + d;
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
    result[gl_WorkGroupID.y * 65536u + uint(d.y * 256 + d.x)] = sum;
}
