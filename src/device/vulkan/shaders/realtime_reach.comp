// The largest radius in front of focus that reaches a tile, from whatever tile it comes, and the box of tiles whose lamps
// reach it.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Tiles { vec2 tiles[]; };
layout(std430, binding = 1) writeonly buffer Reach { vec2 reach[]; };  // in front of focus; of what is blurred pixel by pixel
layout(std430, binding = 2) readonly buffer Lamps { uvec4 lamps[]; };
layout(std430, binding = 3) writeonly buffer Boxes { ivec4 boxes[]; };  // first and last column and row; empty: last < first
#include "realtime.glsl"

// The largest radius that is blurred pixel by pixel, among all between these.
float pixelwise(vec2 range) {
    const float most = max(abs(range.x), abs(range.y)), least = max(0.0, max(range.x, -range.y));
    return most > 0.5 && least < kWholePx ? min(most, kWholePx) : 0.0;
}

void main() {
    const int own = int(gl_GlobalInvocationID.x);
    if (own >= at.tiles.x * at.tiles.y) return;
    const ivec2 tile = ivec2(own % at.tiles.x, own / at.tiles.x);
    const float kLampReach = 1.25, kBorder = 2;  // of the radius; pixels: what a kernel covers
    const ivec2 far = ivec2((kLampReach * vec2(at.most_px, at.most_px * at.aspect) + kBorder) / float(kTile)) + 1;
    const ivec2 low = max(tile - far, ivec2(0)), high = min(tile + far, at.tiles - 1);
    float most = 0, fine = 0;
    ivec4 box = ivec4(at.tiles, -1, -1);
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            const vec2 range = tiles[y * at.tiles.x + x];
            const float radius = -range.x;
            // Between the nearest pixels of both.
            vec2 gap = float(kTile) * vec2(max(abs(ivec2(x, y) - tile) - 1, ivec2(0)));
            gap.y /= at.aspect;
            if (radius > most && dot(gap, gap) <= (radius + 1) * (radius + 1)) most = radius;
            if (gap == vec2(0)) fine = max(fine, pixelwise(range));
            const uvec4 lamp = lamps[y * at.tiles.x + x];
            const float wide = kLampReach * uintBitsToFloat(lamp.z) + kBorder;
            if ((lamp.x | lamp.y) != 0u && max(gap.x, gap.y) <= wide)
                box = ivec4(min(box.xy, ivec2(x, y)), max(box.zw, ivec2(x, y)));
        }
    boxes[own] = box;
    reach[own] = vec2(most, fine);
}
