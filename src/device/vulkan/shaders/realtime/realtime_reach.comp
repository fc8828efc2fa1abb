// Finds the largest radius in front of focus that reaches a tile, from any tile, and the box of tiles whose lamps reach it.
// If too many lamps reach a tile, its own lamps are merged.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;

// Largest radius in front of focus; a bit for each quarter with pixels blurred pixel by pixel, then one for each with these or
// with light in focus; 0; the smallest signed radius that may hide a lamp behind focus (realtime_sprites.glsl: seen).
layout(std430, binding = 0) readonly buffer Tiles { vec4 tiles[]; };
// The largest radius as it reaches a tile; a bit for each quarter of the tile that pixels reach which `combine` reads one by one;
// the first and last of `tiles` of the tile alone.
layout(std430, binding = 1) writeonly buffer Reach { vec4 reach[]; };
layout(std430, binding = 2) readonly buffer Lamps { uvec4 lamps[]; };
layout(std430, binding = 3) writeonly buffer Boxes { ivec4 boxes[]; };  // first column and row, columns, tiles
layout(std430, binding = 4) writeonly buffer Kept { uvec4 kept[]; };    // the lamps that are left, as in `lamps`
layout(std430, binding = 5) buffer CellLamps { uvec4 cell_lamps[]; };
#include "realtime.glsl"

const uint kMostLamps = 256;  // that reach a tile before its own are merged

// Marks the squares of `side` x `side` cells that hold any lamp, at the first cell of each. A mask has 32 cells in a word,
// as four rows of eight.
uvec2 squares_of(uvec2 mask, int side) {
    if (side >= 2) mask = (mask | mask >> 1 | mask >> 8 | mask >> 9) & 0x00550055u;
    if (side >= 4) mask = (mask | mask >> 2 | mask >> 16 | mask >> 18) & 0x00000011u;
    if (side >= 8) mask = uvec2((mask.x | mask.x >> 4 | mask.y | mask.y >> 4) & 1u, 0u);
    return mask;
}

// Lamps on one side of focus become one: all their light, from its middle, over their mean radius.
struct Merged {
    vec3 light, place;  // place, signed radius: times brightness
    float bright;
};
void put(Merged lamp, ivec2 tile, int cell, inout uvec2 left) {
    if (lamp.bright == 0) return;
    // The light is divided by a power of two if halves would not hold it.
    const float most = max(lamp.light.r, max(lamp.light.g, lamp.light.b)), factor = exp2(ceil(max(0.0, log2(most / (4 * kMostLight)))));
    const ivec2 own = ivec2(cell % 8, cell / 8);
    const vec3 place = lamp.place / lamp.bright;
    cell_lamps[lamp_at(8 * tile + own)] = packed_lamp(CellLamp(lamp.light / (4 * factor), 4 * factor, place.xy - 2 * vec2(own), place.z));
    left[cell / 32] |= 1u << (cell % 32);
}
uvec2 merge(ivec2 tile, uvec2 mask, int side) {
    uvec2 left = uvec2(0);
    const uvec2 squares = squares_of(mask, side);
    for (int square = 0; square < 64; ++square) {
        if ((squares[square / 32] >> (square % 32) & 1u) == 0u) continue;
        Merged behind = Merged(vec3(0), vec3(0), 0), before = behind;
        for (int i = 0; i < side * side; ++i) {
            const int cell = square + i / side * 8 + i % side;
            if ((mask[cell / 32] >> (cell % 32) & 1u) == 0u) continue;
            const ivec2 own = ivec2(cell % 8, cell / 8);
            const CellLamp lamp = unpacked_lamp(cell_lamps[lamp_at(8 * tile + own)]);
            const vec3 light = lamp.factor * lamp.light;
            const float bright = brightness(vec4(light, 0));
            const vec3 place = bright * vec3(2 * vec2(own) + lamp.place, lamp.radius);
            if (lamp.radius < 0) before.light += light, before.place += place, before.bright += bright;
            else behind.light += light, behind.place += place, behind.bright += bright;
        }
        put(behind, tile, square, left), put(before, tile, square + 1, left);
    }
    return left;
}

// Merges the tile's lamps until no more than kMostLamps would reach a tile if all tiles around were like this one. At least
// one lamp stays on each side of focus.
uvec2 thinned(ivec2 tile, uvec2 mask, uint all) {
    const uint own = uint(bitCount(mask.x) + bitCount(mask.y)), most = max(1u, own * kMostLamps / max(all, 1u));
    if (own <= most) return mask;
    int side = 2;
    for (; side < 8; side *= 2) {
        const uvec2 squares = squares_of(mask, side);
        if (uint(bitCount(squares.x) + bitCount(squares.y)) <= most) break;
    }
    return merge(tile, mask, side);
}

// A bit for each quarter of a tile that touches a quarter of this neighbour with its bit set.
uint touched(uint quarters, ivec2 to) {
    const uint kColumns[3] = {5u, 15u, 10u}, kRows[3] = {3u, 15u, 12u};  // first, all, last
    const uint facing = kColumns[1 - to.x] & kRows[1 - to.y];
    return (quarters & facing) == 0u ? 0u : kColumns[1 + to.x] & kRows[1 + to.y];
}

void main() {
    const int own = int(gl_GlobalInvocationID.x);
    if (own >= at.tiles.x * at.tiles.y) return;
    const ivec2 tile = ivec2(own % at.tiles.x, own / at.tiles.x);
    const float kLampReach = 1.25, kBorder = 2;  // of the radius; pixels: what a kernel covers
    const ivec2 far = ivec2((kLampReach * vec2(at.most_px, at.most_px * at.aspect) + kBorder) / float(kTile)) + 1;
    const ivec2 low = max(tile - far, ivec2(0)), high = min(tile + far, at.tiles - 1);
    const float per_aspect = 1 / at.aspect;
    float most = 0;
    uint fine = 0u;
    uint all = 0;
    ivec4 box = ivec4(at.tiles, -1, -1);
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            const vec4 found = tiles[y * at.tiles.x + x];
            const float radius = found.x;
            // Distance between the nearest pixels of both.
            vec2 gap = float(kTile) * vec2(max(abs(ivec2(x, y) - tile) - 1, ivec2(0)));
            gap.y *= per_aspect;
            if (radius > most && dot(gap, gap) <= (radius + 1) * (radius + 1)) most = radius;
            if (gap == vec2(0)) {
                const uint quarters = uint(found.y);
                fine |= touched(quarters, ivec2(x, y) - tile) | touched(quarters >> 4, ivec2(x, y) - tile) << 4;
            }
            const uvec4 lamp = lamps[y * at.tiles.x + x];
            if ((lamp.x | lamp.y) == 0u) continue;
            if (max(gap.x, gap.y) > kLampReach * uintBitsToFloat(lamp.z) + kBorder) continue;
            box = ivec4(min(box.xy, ivec2(x, y)), max(box.zw, ivec2(x, y)));
            all += uint(bitCount(lamp.x) + bitCount(lamp.y));
        }
    const ivec2 across = max(box.zw - box.xy + 1, ivec2(0));
    boxes[own] = ivec4(box.xy, across.x, across.x * across.y);
    // Near surfaces may cover light in focus.
    const vec2 range = tiles[own].xw;
    reach[own] = vec4(most, float(range.x > 2 ? fine >> 4 : fine & 15u), range);
    const uvec4 lamp = lamps[own];
    kept[own] = uvec4(all > kMostLamps ? thinned(tile, lamp.xy, all) : lamp.xy, lamp.zw);
}
