// Lamps as sprites: each with the lens's own kernel, at its own place and radius.
layout(std430, binding = 5) readonly buffer Lens { vec4 lens[]; };    // engine/gather/realtime_plan.h
layout(std430, binding = 6) readonly buffer Lamps { uvec4 lamps[]; };  // realtime_split.comp
layout(std430, binding = 7) readonly buffer Boxes { ivec4 boxes[]; };  // realtime_reach.comp

const int kLampSteps = 14, kFirstStep = 127 + 64 + 2 * 64 * 64;
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

// What of a lamp behind focus is seen from a pixel: on its way to (x, y) light has its radius at `from` and none at
// `to`; where something nearer has just the radius that is left, it stops there.
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

// And what things in front of focus let through, `near_px` at most: beyond the pixel light goes on to where it would have
// the radius of what stands there.
float let_through(vec2 from, vec2 to, float radius, float near_px) {
    const int kSteps = 8;
    const float step_of = near_px / (radius * float(kSteps));
    const float level = clamp(log2(0.5 * step_of * length(to - from)), 0.0, 3.0);
    float hidden = 0;
    for (int i = 1; i <= kSteps; ++i) {
        const float way = float(i) * step_of;
        const vec2 place = mix(from, to, 1 + way) * 0.5 / vec2(8 * at.tiles);
        const vec2 near = textureLod(cells, vec3(place, kNear), level).xy;
        if (near.x > 1e-3) hidden += near.x * max(0.0, 1 - abs(near.y / near.x / radius - way) / step_of);
    }
    return 1 - min(hidden, 1.0);
}

// Adds the lamps of one tile, in the order of its cells.
void add_lamps(ivec2 tile, uvec2 mask, vec2 pixel, float near_px, inout vec4 near, inout vec4 back) {
    for (int half_of = 0; half_of < 2; ++half_of)
        for (uint left = mask[half_of]; left != 0u; left &= left - 1u) {
            const int i = findLSB(left) + 32 * half_of;
            const ivec2 cell = 8 * tile + ivec2(i % 8, i / 8);
            const vec3 lamp = texelFetch(cells, ivec3(cell, kLampPlace), 0).xyz;
            const vec2 from = vec2(2 * cell) + lamp.xy;
            const vec4 share = kernel_at(pixel - from, lamp.z);
            if (share.a == 0) continue;
            const vec4 light = share * vec4(4 * texelFetch(cells, ivec3(cell, kLampLight), 0).rgb, 0);
            if (lamp.z < 0) near += light;
            else back += light * seen(from, pixel, lamp.z) * (near_px > 0.5 ? let_through(from, pixel, lamp.z, near_px) : 1.0);
        }
}

void add_all_lamps(ivec2 pixel, float near_px, inout vec4 near, inout vec4 back) {
    const ivec2 own = pixel / kTile;
    const ivec4 box = boxes[own.y * at.tiles.x + own.x];
    for (int y = box.y; y <= box.w; ++y)
        for (int x = box.x; x <= box.z; ++x) {
            const uvec4 head = lamps[y * at.tiles.x + x];
            if ((head.x | head.y) != 0u) add_lamps(ivec2(x, y), head.xy, vec2(pixel) + 0.5, near_px, near, back);
        }
}
