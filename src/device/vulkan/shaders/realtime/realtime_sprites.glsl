// Lamps as sprites: each with the lens's own kernel, at its own place and radius.
layout(std430, binding = 5) readonly buffer Lens { vec4 lens[]; };    // engine/gather/realtime_plan.h
layout(std430, binding = 6) readonly buffer Kept { uvec4 lamps[]; };  // realtime_reach.comp
layout(std430, binding = 7) readonly buffer Boxes { ivec4 boxes[]; };  // realtime_reach.comp
layout(std430, binding = 9) readonly buffer CellLamps { uvec4 cell_lamps[]; };

const int kLampSteps = 14;
const float kStepAt = 0.5;  // pixels: the radius of the first kernel; the next are sqrt(2) times as wide each

// Lamps as a group reads them, so many at a time. More shared memory would leave fewer groups in flight.
const int kLampsAtOnce = 32;
struct Lamp {
    vec2 from;       // cells
    float radius, per_radius;  // signed; 1 / its size
    float least_px;  // of seen(): where it has less, no radius between the lamp's tile and the group's hides it
    float step_of, per_px;  // of let_through()
    vec4 to_cells;   // scale and offset from pixels to the cells of its kernel, from the middle one
    vec3 light;      // times the size of a kernel's cell
    float reach;     // squared distance from the middle without light, cells
    uint kernel;     // cells in a row of its kernel; from bit 8, the middle cell in the zone above the lamp and left of it
    uint zone_share;  // of the next column and row of zones, 16 bits each
};
shared Lamp group_lamps[kLampsAtOnce];
shared uint reaching;  // those that reach a pixel of the group: a bit for each

Lamp lamp_of_cell(ivec2 cell, float least_px, float near_px, out bool reaches) {
    const CellLamp lamp = unpacked_lamp(cell_lamps[lamp_at(cell)]);
    const float radius = max(abs(lamp.radius), kStepAt);
    // The nearest kernel keeps the light of small discs; the next larger one keeps the rims of large ones sharp.
    const float place_of = 2 * log2(radius / kStepAt);
    const int kernel = clamp(int(radius < 8 ? round(place_of) : ceil(place_of - 0.1)), 0, kLampSteps - 1);
    const vec4 head = lens[0];
    const vec2 from = vec2(2 * cell) + lamp.place, zones = head.zw, zone_at = zone_place(from, zones);
    const ivec2 zone = ivec2(min(zone_at, max(zones - 2, vec2(0))));
    const int of_zone = size_of_zone(head), next_zone = first_zone_of(head) + of_zone * (zone.y * int(zones.x) + zone.x + 1);
    const vec4 kept = lens[next_zone - kOfLamps + kernel + (lamp.radius < 0 ? 0 : kLampSteps)];
    const float cells_per_px = kept.z / radius;
    const vec2 scale = vec2(cells_per_px, cells_per_px / at.aspect);
    const vec2 gap = scale * max(abs(vec2(8 * ivec2(gl_WorkGroupID.xy) + 4) - from) - 3.5, vec2(0));
    reaches = dot(gap, gap) < kept.w;
    const int half_side = int(kept.y), side = 2 * half_side + 1;
    const vec3 light = lamp.factor * cells_per_px * cells_per_px / at.aspect * lamp.light;
    const float per_radius = 1 / abs(lamp.radius), step_px = kShadowStep * lamp.radius;
    const float end_px = least_px < 0.95 * lamp.radius ? max(least_px - step_px, 0.0) - 1e-3 * step_px : at.most_px;
    const float before = lamp.radius < 0 ? 1.0 : 0.0, step_of = max(near_px * per_radius - before, 0.0) * kShadowStep, per_step = 1 / max(step_of, 1e-6);
    return Lamp(0.5 * from, lamp.radius, per_radius, end_px, lamp.radius < 0 ? -step_of : step_of, per_radius * per_step,
                vec4(scale, -from * scale), light, kept.w, uint(int(kept.x) + half_side * (side + 1)) << 8 | uint(side), packUnorm2x16(zone_at - vec2(zone)));
}

vec3 cell_at(int first, int side, vec2 share) {
    return mix(mix(lens[first].rgb, lens[first + 1].rgb, share.x), mix(lens[first + side].rgb, lens[first + side + 1].rgb, share.x), share.y);
}
// The share of its light that a lamp sends to this place among its kernel's cells, interpolated between zones of the lens.
vec3 kernel_at(int lamp, vec2 place) {
    const uint kernel = group_lamps[lamp].kernel;
    const int side = int(kernel & 255u);
    const vec2 low = floor(place), share = place - low;
    const int first = int(kernel >> 8) + int(low.y * float(side) + low.x);
    if (group_lamps[lamp].zone_share == 0u) return cell_at(first, side, share);
    const vec2 zone_share = unpackUnorm2x16(group_lamps[lamp].zone_share);
    const int of_zone = size_of_zone(lens[0]);
    vec3 sum = (1 - zone_share.x) * (1 - zone_share.y) * cell_at(first, side, share);
    if (zone_share.x > 0) sum += zone_share.x * (1 - zone_share.y) * cell_at(first + of_zone, side, share);
    if (zone_share.y > 0) {
        const int below = first + of_zone * int(lens[0].z);
        sum += (1 - zone_share.x) * zone_share.y * cell_at(below, side, share);
        if (zone_share.x > 0) sum += zone_share.x * zone_share.y * cell_at(below + of_zone, side, share);
    }
    return sum;
}

// Loops of steps are not unrolled, because more registers would leave fewer groups in flight.

// Visible share of a lamp behind focus from a pixel: on its way to (x, y) light has its radius at `from` and
// none at `to`, both in cells; an occluder with the remaining radius stops it there. An occluder of radius
// -radius / kShadowSteps or less stops nothing, and `split` leaves it out of the smallest radii of tiles. least_px: the
// remaining radius of the last step.
float seen(vec2 from, vec2 to, float radius, float per_radius, float least_px) {
    const vec2 step_cells = kShadowStep * (to - from);
    const float step_px = kShadowStep * radius, per_step = float(kShadowSteps) * per_radius;
    vec2 place = from;
    float hidden = 0, hides_px = 0.95 * radius;  // radii above it hide nothing at this step
    [[dont_unroll]] for (float left_px = radius - step_px; left_px >= least_px; hides_px = left_px, left_px -= step_px) {
        place += step_cells;
        const ivec2 cell = ivec2(place);
        const vec4 radii = texelFetch(cells, ivec3(cell, kRadii), 0);
        if (min(min(radii.x, radii.y), min(radii.z, radii.w)) > hides_px) continue;  // most cells hide nothing
        const ivec2 pixel = ivec2(2 * place);
        const float there = radii[(pixel.y & 1) << 1 | pixel.x & 1], nearer = 1 - there * per_radius;
        if (nearer < 0.05 || mark_of(there) == kSilhouette) continue;
        hidden += ramp(0.05, 0.2, nearer) * max(0.0, 1 - per_step * abs(left_px - there));
        if (hidden >= 1) return 0;
    }
    return 1 - hidden;
}

// Share of a lamp's light that occluders in front of focus let through. The light of a lamp behind focus continues past the
// pixel, to the place where it would have the occluder's radius. The light of a lamp in front of focus passes nearer occluders
// on the lamp's other side. One loop serves both lamps, because drivers that compute on the CPU run both sides of a branch.
// step_of: a step, as a part of the way from the lamp to the pixel; negative for a lamp in front of focus. An occluder lies
// per_px steps from focus for each pixel of its radius, and the lamp in front of focus `begin` steps.
float let_through(vec2 from, vec2 to, float radius, float step_of, float per_px) {
    const bool is_near = step_of < 0;
    const float begin = is_near ? -radius * per_px : 0.0;
    const vec2 step_cells = step_of * (to - from);
    const float level = clamp(0.5 * log2(dot(step_cells, step_cells)), 0.0, 3.0);
    vec2 place = (is_near ? from : to) * texel, step_at = step_cells * texel;
    // The way past a small lamp may lead beyond the cells that the frame has.
    if (is_near) step_at = min(step_at, kShadowStep * (farthest_place(texel) - place));
    float hidden = 0;
    const float last = begin + float(kShadowSteps) + 0.5;
    [[dont_unroll]] for (float way = begin + 1; way < last; ++way) {
        place += step_at;
        const vec3 near = textureLod(cells, vec3(place, kNear), level).xyz;
        if (near.x <= 1e-3) continue;
        const float beside = abs(per_px * near.y - way * near.z);  // times near.z: steps between the surface and this one
        if (beside >= near.z) continue;
        const float covers = 1 - beside / near.z;
        // A lamp is not cut by the surface that it hangs on.
        hidden += near.x * covers * (is_near ? ramp(0.2, 0.5, step_of * (begin - per_px * near.y / near.z)) : 1.0);
        if (hidden >= 1) return 0;
    }
    return 1 - hidden;
}

// Adds the lamps of a group that reach it to a pixel. open: the share of those behind focus; has_near: near light reaches the
// pixel.
void add_lamps(vec2 pixel, bool has_near, float open, inout vec4 made) {
    const float least_step = has_near ? 0.0 : at.most_px;
    const vec2 to = 0.5 * pixel;
    for (uint left = reaching; left != 0u; left &= left - 1u) {
        const int i = findLSB(left);
        const vec4 to_cells = group_lamps[i].to_cells;
        const vec2 place = pixel * to_cells.xy + to_cells.zw;
        if (dot(place, place) >= group_lamps[i].reach) continue;
        const vec3 share = kernel_at(i, place);
        const float radius = group_lamps[i].radius;
        if (share.r + share.g + share.b == 0) continue;
        float shows = radius > 0 ? open : 1.0;
        const vec2 from = group_lamps[i].from;
        const float step_of = group_lamps[i].step_of, least_px = group_lamps[i].least_px;
        if (step_of < 0 || step_of > least_step) shows *= let_through(from, to, radius, step_of, group_lamps[i].per_px);
        if (least_px < radius && shows > 0) shows *= seen(from, to, radius, group_lamps[i].per_radius, least_px);  // else nothing is nearer
        made.rgb += shows * share * group_lamps[i].light;
    }
}

// True if lamps of a tile, at most this wide, may reach a pixel of the group.
bool reaches_group(ivec2 tile, float radius_px) {
    const float wide = 1.25 * radius_px + 2 + radius_px / 16;  // what a kernel covers, and its rim
    const ivec2 group = 8 * ivec2(gl_WorkGroupID.xy), gap = max(kTile * tile - group - 7, group - kTile * tile - kTile + 1);
    return max(float(gap.x) - 0.5, (float(gap.y) - 0.5) / at.aspect) <= wide;
}

// The smallest signed radius of two tiles, and of those that lines from one to the other cross.
float least_between(ivec2 a, ivec2 b) {
    const ivec2 low = min(a, b), high = max(a, b), way = b - a;
    const int wide = abs(way.x) + abs(way.y);
    float least = at.most_px;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
            if (abs((x - a.x) * way.y - (y - a.y) * way.x) < max(wide, 1)) least = min(least, reach[y * at.tiles.x + x].w);
    return least;
}

// All invocations of the group call it together: each looks at a tile of the box, and then reads one of the lamps found.
// Lamps that no pixel of the group sees cost the others nothing more.
shared uint lamp_counts[64], all_lamps;  // of the tiles
shared uvec2 lamps_found[kLampsAtOnce];  // cell: column, row << 16; bits of the smallest radius up to its tile
void add_all_lamps(ivec2 pixel, ivec2 own_tile, float near_px, bool has_near, float open, inout vec4 made) {
    const uint own = gl_LocalInvocationIndex;
    const ivec4 box = boxes[own_tile.y * at.tiles.x + own_tile.x];
    const int across = box.z, count = box.w;
    for (int first = 0; first < count; first += 64) {
        uvec2 mask = uvec2(0);  // cells of the tile that have lamps
        ivec2 tile = ivec2(0);
        uint least_px = 0u;
        const int i = first + int(own);
        if (i < count) {
            tile = box.xy + ivec2(i % across, i / across);
            const uvec4 head = lamps[tile.y * at.tiles.x + tile.x];
            if ((head.x | head.y) != 0u && reaches_group(tile, uintBitsToFloat(head.z))) {
                mask = head.xy;
                least_px = floatBitsToUint(least_between(tile, own_tile));
            }
        }
        const uint lamps_of_tile = uint(bitCount(mask.x) + bitCount(mask.y));
        barrier();
        if (own == 0u) all_lamps = 0u;
        barrier();
        lamp_counts[own] = lamps_of_tile;
        atomicAdd(all_lamps, lamps_of_tile);
        barrier();
        const uint all = all_lamps;
        uint before = 0u;
        if (lamps_of_tile > 0u)
            for (uint k = 0u; k < own; ++k) before += lamp_counts[k];
        for (uint begin = 0u; begin < all; begin += uint(kLampsAtOnce)) {
            uvec2 left = mask;
            for (uint number = before; (left.x | left.y) != 0u && number < begin + uint(kLampsAtOnce); ++number) {
                const bool is_first = left.x != 0u;
                const int cell = is_first ? findLSB(left.x) : 32 + findLSB(left.y);
                if (is_first) left.x &= left.x - 1u;
                else left.y &= left.y - 1u;
                const uvec2 place = uvec2(8 * tile + ivec2(cell % 8, cell / 8));
                if (number >= begin) lamps_found[number - begin] = uvec2(place.x | place.y << 16, least_px);
            }
            if (own == 0u) reaching = 0u;
            barrier();
            if (own < min(all - begin, uint(kLampsAtOnce))) {
                const uvec2 lamp = lamps_found[own];
                bool reaches;
                group_lamps[own] = lamp_of_cell(ivec2(lamp.x & 0xffffu, lamp.x >> 16), uintBitsToFloat(lamp.y), near_px, reaches);
                if (reaches) atomicOr(reaching, 1u << own);
            }
            barrier();
            add_lamps(vec2(pixel) + 0.5, has_near, open, made);
            barrier();
        }
    }
}
