// Lamps as sprites: each with the lens's own kernel, at its own place and radius.
layout(std430, binding = 5) readonly buffer Lens { vec4 lens[]; };    // engine/gather/realtime_plan.h
layout(std430, binding = 6) readonly buffer Lamps { uvec4 lamps[]; };  // realtime_reach.comp: kept
layout(std430, binding = 7) readonly buffer Boxes { ivec4 boxes[]; };  // realtime_reach.comp

const int kLampSteps = 14, kFirstStep = 1 + 4 * 127 * (1 + 2 * 64);
const float kStepAt = 0.5;  // pixels: the radius of the first kernel; the next are sqrt(2) times as wide each

// The share of its light that a lamp sends to an offset in pixels.
vec4 kernel_at(vec2 offset, float radius_px) {
    const float radius = max(abs(radius_px), kStepAt);
    const int step_of = clamp(int(round(2 * log2(radius / kStepAt))), 0, kLampSteps - 1);
    const vec4 kept = lens[kFirstStep + step_of + (radius_px < 0 ? 0 : kLampSteps)];
    const float cells_per_px = kept.z / radius;
    const int half_side = int(kept.y), side = 2 * half_side + 1;
    const vec2 place = vec2(offset.x, offset.y / at.aspect) * cells_per_px + float(half_side);
    if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(side - 1)))) return vec4(0);
    const ivec2 low = ivec2(place);
    const vec2 share = place - vec2(low);
    const int first = int(kept.x) + low.y * side + low.x;
    return cells_per_px * cells_per_px / at.aspect *
           mix(mix(lens[first], lens[first + 1], share.x), mix(lens[first + side], lens[first + side + 1], share.x), share.y);
}

// Visible share of a lamp behind focus from a pixel: on its way to (x, y) light has its radius at `from` and
// none at `to`; an occluder with the remaining radius stops it there.
float seen(vec2 from, vec2 to, float radius) {
    const int kSteps = 8;
    float hidden = 0;
    for (int i = 1; i <= kSteps; ++i) {
        const float way = float(i) / float(kSteps);
        const ivec2 pixel = clamp(ivec2(floor(mix(from, to, way))), ivec2(0), at.size - 1);
        const float there = radius_at(pixel);
        const float is_nearer = smoothstep(0.05, 0.2, 1 - there / radius);
        hidden += is_nearer * max(0.0, 1 - float(kSteps) * abs(1 - there / radius - way));
    }
    return 1 - min(hidden, 1.0);
}

// Share of a lamp's light that occluders in front of focus let through; their radii are at most near_px. The light of a
// lamp behind focus continues past the pixel, to the place where it would have the occluder's radius. The light of a lamp
// in front of focus passes nearer occluders on the lamp's other side. One loop serves both lamps, because drivers that
// compute on the CPU run both sides of a branch.
float let_through(vec2 from, vec2 to, float radius, float near_px) {
    const int kSteps = 8;
    const bool is_near = radius < 0;
    const float begin = is_near ? 1.0 : 0.0, step_of = (near_px / abs(radius) - begin) / float(kSteps);
    if (step_of <= 0) return 1;
    const vec2 start = is_near ? from : to, way_px = is_near ? from - to : to - from;
    const float level = clamp(log2(0.5 * step_of * length(way_px)), 0.0, 3.0);
    float hidden = 0;
    for (int i = 1; i <= kSteps; ++i) {
        const float way = float(i) * step_of;
        const vec2 place = (start + way * way_px) * 0.5 / vec2(8 * at.tiles);
        const vec3 near = textureLod(cells, vec3(place, kNear), level).xyz;
        const float there = near.y / max(near.z, 1e-7) / abs(radius) - begin;
        const float covers = near.x > 1e-3 ? near.x * max(0.0, 1 - abs(there - way) / step_of) : 0.0;
        hidden += covers * (is_near ? smoothstep(0.2, 0.5, there) : 1.0);  // a lamp is not cut by what it hangs on
    }
    return 1 - min(hidden, 1.0);
}

// Adds the lamps of one tile, in the order of its cells.
void add_lamps(ivec2 tile, uvec2 mask, vec2 pixel, float near_px, inout vec4 near, inout vec4 back) {
    for (int half_of = 0; half_of < 2; ++half_of)
        for (uint left = mask[half_of]; left != 0u; left &= left - 1u) {
            const int i = findLSB(left) + 32 * half_of;
            const ivec2 cell = 8 * tile + ivec2(i % 8, i / 8);
            const vec4 lamp = texelFetch(cells, ivec3(cell, kLampPlace), 0);
            const vec2 from = vec2(2 * cell) + lamp.xy;
            const vec4 share = kernel_at(pixel - from, lamp.z);
            if (share.a == 0) continue;
            vec4 light = share * vec4(lamp.w * texelFetch(cells, ivec3(cell, kLampLight), 0).rgb, 0);
            if (near_px > 0.5) light *= let_through(from, pixel, lamp.z, near_px);
            if (lamp.z < 0) near += light;
            else back += light * seen(from, pixel, lamp.z);
        }
}

shared uvec3 heads[64];  // which cells of a tile have lamps, and where the tile is
shared uint head_words[2];

// True if lamps of a tile, at most this wide, may reach a pixel of the group.
bool reaches_group(ivec2 tile, float radius_px) {
    const float wide = 1.25 * radius_px + 2 + radius_px / 16;  // what a kernel covers, and its rim
    const ivec2 group = 8 * ivec2(gl_WorkGroupID.xy), gap = max(kTile * tile - group - 7, group - kTile * tile - kTile + 1);
    return max(float(gap.x) - 0.5, (float(gap.y) - 0.5) / at.aspect) <= wide;
}

// All invocations of the group together: each looks at a tile of the box; what none of their pixels sees costs them no more.
void add_all_lamps(ivec2 pixel, float near_px, inout vec4 near, inout vec4 back) {
    const uint own = gl_LocalInvocationIndex;
    const ivec2 own_tile = 8 * ivec2(gl_WorkGroupID.xy) / kTile;
    const ivec4 box = boxes[own_tile.y * at.tiles.x + own_tile.x];
    const int across = max(box.z - box.x + 1, 0), count = across * max(box.w - box.y + 1, 0);
    for (int first = 0; first < count; first += 64) {
        barrier();
        if (own < 2u) head_words[own] = 0u;
        barrier();
        const int i = first + int(own);
        if (i < count) {
            const ivec2 tile = box.xy + ivec2(i % across, i / across);
            const uvec4 head = lamps[tile.y * at.tiles.x + tile.x];
            if ((head.x | head.y) != 0u && reaches_group(tile, uintBitsToFloat(head.z))) {
                heads[own] = uvec3(head.xy, uint(tile.x) | uint(tile.y) << 16);
                atomicOr(head_words[own / 32u], 1u << (own % 32u));
            }
        }
        barrier();
        for (uint word = 0u; word < 2u; ++word)
            for (uint left = head_words[word]; left != 0u; left &= left - 1u) {
                const uvec3 head = heads[findLSB(left) + 32 * int(word)];
                add_lamps(ivec2(head.z & 0xffffu, head.z >> 16), head.xy, vec2(pixel) + 0.5, near_px, near, back);
            }
    }
}
