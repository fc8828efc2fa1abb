// Draws 16 x 16 pixels of a tile, through one sector of the pupil (docs/explain/vulkan.md, "Composite").
// The words of the plan are those that composite.cpp writes; formulas are device/cpu's.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "laws/compositing.h"
#include "laws/tiles.h"
layout(local_size_x = 256) in;
layout(constant_id = 0) const uint kHeld = 0;  // 1: a holdout dims what lands in a pixel

layout(std430, binding = 0) readonly buffer PlanWords { uint plan[]; };
layout(std430, binding = 1) readonly buffer Sources { vec4 sources[]; };      // three to a source
layout(std430, binding = 2) readonly buffer KernelWords { uint kernels[]; };
layout(std430, binding = 3) readonly buffer Weights { float weights[]; };
layout(std430, binding = 4) readonly buffer Holdout { uint holdout[]; };
layout(std430, binding = 5) writeonly buffer Light { vec4 light_of[]; };      // by pixel of a tile's sector
layout(std430, binding = 6) writeonly buffer Taken { float taken_of[]; };
layout(push_constant) uniform Push {
    uint tiles, layers, runs, arrivals, shares;  // where these begin in `plan`; shares 0: there are none
    uint first_layer, first_run, first_arrival;  // numbers of the first of each
    uint records;                                // where records of kernels begin in `kernels`
    uint held_rows, held_width, held_samples;    // row 0 of the holdout, its width; where samples begin
} at;

const int kSide = kGroupSide, kChunk = kGroup, kBlocks = 8, kTileWords = 8, kLayerWords = 5, kRunWords = 3;
const int kTilePixels = kScatterTile * kScatterTile;
const uint kGroupsAcross = kScatterTile / kSide, kGroupsOfTile = kGroupsAcross * kGroupsAcross;

// Arrivals of a chunk that touch the group's pixels.
shared vec4 hit_light[kChunk];  // and, when they are done, sums of cells
shared vec4 hit_shape[kChunk];  // tilt x, y; off the middle x, y
shared int hit_x[kChunk], hit_y[kChunk];
shared uint hit_corner[kChunk], hit_size[kChunk], hit_weights[kChunk];
shared uint hit_words[kChunk / 32];
shared uint hits_of_block[kBlocks * kChunk / 32];  // which of them touch a block
shared uint any_free;

struct Box { ivec2 low, high; };

#include "kernels.glsl"

// The weights of a kernel at an offset from a source.
vec4 weight_at(ivec2 offset, uint corner, uint size, uint where) {
    const ivec2 d = offset - halves(corner), wide = halves(size);
    if (any(lessThan(d, ivec2(0))) || any(greaterThanEqual(d, wide))) return vec4(0);
    return weight(d, wide, where);
}

// Light that hit number k sends to a cell.
vec4 sent(uint k, ivec2 cell) {
    const vec4 shape = hit_shape[k];
    const ivec2 d = cell - ivec2(hit_x[k], hit_y[k]);
    const uint corner = hit_corner[k], size = hit_size[k], where = hit_weights[k];
    if (shape.zw == vec2(0)) {
        const vec4 w = weight_at(d, corner, size, where);
        return w == vec4(0) ? w : w * (hit_light[k] * max(0.0, 1 + dot(shape.xy, vec2(d))));
    }
    // Off the middle of its cell it is shared with its neighbours.
    const ivec2 to = ivec2(shape.z < 0 ? -1 : 1, shape.w < 0 ? -1 : 1);
    const vec2 share = abs(shape.zw);
    vec4 sum = vec4(0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const float part = (i == 0 ? 1 - share.x : share.x) * (j == 0 ? 1 - share.y : share.y);
            const ivec2 e = d - ivec2(i, j) * to;
            if (part > 0)
                sum += weight_at(e, corner, size, where) * (part * max(0.0, 1 + dot(shape.xy, vec2(e))));
        }
    return sum * hit_light[k];
}

// Corner of a block of 8 x 4 of the group's pixels, one for each of 32 consecutive invocations: the smallest
// part that most devices run in step reads only the arrivals that touch it.
ivec2 corner_of_block(uint block) { return ivec2(block % 2u, block / 2u) * ivec2(8, 4); }

bool meet(Box a, Box b) { return all(lessThan(a.low, b.high)) && all(greaterThan(a.high, b.low)); }

// Landing of an arrival; neighbours of its cell may send as well.
Box reach(ivec2 place, vec4 shape, uint record) {
    const ivec2 corner = place + halves(kernels[record]), size = halves(kernels[record + 1u]);
    const vec2 to = sign(shape.zw);
    return Box(corner + ivec2(min(to, vec2(0))), corner + size + ivec2(max(to, vec2(0))));
}

// Notes which arrivals from `first` on, `count` of them, touch the box; returns how many.
uint find_hits(uint first, uint count, uint base, uint sector, Box box) {
    const uint own = gl_LocalInvocationIndex;
    if (own < kChunk / 32) hit_words[own] = 0u;
    if (own < kBlocks * kChunk / 32) hits_of_block[own] = 0u;
    barrier();
    bool hits = false;
    vec4 light, shape;
    ivec2 place;
    uint record = 0u;
    float share = 1;
    if (own < count) {
        const uint i = at.arrivals + 2u * (first + own);
        const uint source = 3u * (plan[i] - base);
        record = at.records + 3u * (kernels[plan[i + 1u]] + sector);
        const vec4 shapes = sources[source + 1u], places = sources[source + 2u];
        place = ivec2(floatBitsToInt(places.z), floatBitsToInt(places.w) >> 2);
        shape = vec4(shapes.yzw, places.x);
        hits = meet(reach(place, shape, record), box) && (kernels[record + 1u] & 0xffffu) != 0u;
        if (hits) {
            if (at.shares != 0u) share = uintBitsToFloat(plan[at.shares + first + own]);
            light = sources[source] * share;
            atomicOr(hit_words[own / 32u], 1u << (own % 32u));
        }
    }
    barrier();
    uint rank = 0u, all_hits = 0u;
    for (uint w = 0u; w < kChunk / 32; ++w) {
        const uint word = hit_words[w];
        if (w < own / 32u) rank += bitCount(word);
        if (w == own / 32u) rank += bitCount(word & ((1u << (own % 32u)) - 1u));
        all_hits += bitCount(word);
    }
    if (hits) {
        hit_light[rank] = light, hit_shape[rank] = shape;
        hit_x[rank] = place.x, hit_y[rank] = place.y;
        hit_corner[rank] = kernels[record], hit_size[rank] = kernels[record + 1u];
        hit_weights[rank] = kernels[record + 2u];
        const Box lit = reach(place, shape, record);
        for (uint block = 0u; block < kBlocks; ++block) {
            const ivec2 first = box.low + corner_of_block(block);
            if (meet(lit, Box(first, first + ivec2(8, 4))))
                atomicOr(hits_of_block[block * (kChunk / 32) + rank / 32u], 1u << (rank % 32u));
        }
    }
    barrier();
    return all_hits;
}

// The first hit from number k on that touches the block of this invocation; `hits`: none does.
uint next_of_block(uint k, uint hits) {
    const uint block = gl_LocalInvocationIndex / 32u * (kChunk / 32);
    for (uint mask = ~0u << (k % 32u); k < hits; mask = ~0u, k = (k / 32u + 1u) * 32u) {
        const uint left = hits_of_block[block + k / 32u] & mask;
        if (left != 0u) return k / 32u * 32u + uint(findLSB(left));
    }
    return hits;
}

// Light that a run sends to a cell: from every arrival whose number among the hits is `slice` of `slices`,
// or, by_block, from all that touch the block of this invocation, which the cell lies in.
vec4 gathered(uint run, uint sector, Box box, ivec2 cell, bool wanted, bool by_block, uint slice,
              uint slices) {
    const uint word = at.runs + kRunWords * (run - at.first_run);
    const uint begin = plan[word] - at.first_arrival, end = plan[word + kRunWords] - at.first_arrival;
    const uint base = plan[word + 2u];
    vec4 sum = vec4(0);
    for (uint first = begin; first < end; first += kChunk) {
        const uint hits = find_hits(first, min(uint(kChunk), end - first), base, sector, box);
        uint k = by_block ? next_of_block(0u, hits) : slice;
        while (wanted && k < hits) {
            sum += sent(k, cell);
            k = by_block ? next_of_block(k + 1u, hits) : k + slices;
        }
        barrier();
    }
    return sum;
}

// Weights of the four cells around a position t (0…1) between the middle two: Catmull-Rom.
vec4 cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return 0.5 * vec4(-t3 + 2 * t2 - t, 3 * t3 - 5 * t2 + 2, -3 * t3 + 4 * t2 + t, t3 - t2);
}

// Never negative where none of the four is.
vec4 interpolated(vec4 a, vec4 b, vec4 c, vec4 d, vec4 w) {
    const vec4 least = min(min(min(a, b), min(c, d)), vec4(0));
    return max(w.x * a + w.y * b + w.z * c + w.w * d, least);
}

vec4 enlarged(ivec2 pixel, int level, Box cells) {
    const vec2 position = (vec2(pixel) + 0.5) / float(1 << level) - 0.5;
    const ivec2 cell = ivec2(floor(position));
    const vec4 wx = cubic(position.x - float(cell.x)), wy = cubic(position.y - float(cell.y));
    const int wide = cells.high.x - cells.low.x;
    vec4 rows[4];
    for (int j = 0; j < 4; ++j) {
        const int i = (cell.y - 1 + j - cells.low.y) * wide + cell.x - 1 - cells.low.x;
        rows[j] = interpolated(hit_light[i], hit_light[i + 1], hit_light[i + 2], hit_light[i + 3], wx);
    }
    return interpolated(rows[0], rows[1], rows[2], rows[3], wy);
}

// Light that a run sends to a pixel, through one sector.
vec4 arrived(uint run, uint sector, Box box, ivec2 pixel, bool inside) {
    const uint own = gl_LocalInvocationIndex;
    const int level = int(plan[at.runs + kRunWords * (run - at.first_run) + 1u]);
    Box cells = box;
    ivec2 cell = pixel;
    bool wanted = inside;
    uint count = 1u, slices = 1u;
    if (level > 0) {
        cells = Box((box.low >> level) - kScatterBorder, ((box.high - 1) >> level) + 1 + kScatterBorder);
        const ivec2 size = cells.high - cells.low;
        count = uint(size.x * size.y), slices = uint(kChunk) / count;
        cell = cells.low + ivec2(int(own % count) % size.x, int(own % count) / size.x);
        wanted = own < slices * count;
    }
    const vec4 part =
        gathered(run, sector, cells, cell, wanted, level == 0, level > 0 ? own / count : 0u, slices);
    if (level == 0) return part;
    hit_light[own] = part;
    barrier();
    vec4 whole = vec4(0);
    if (own < count)
        for (uint s = 0u; s < slices; ++s) whole += hit_light[own + s * count];
    barrier();
    if (own < count) hit_light[own] = whole;
    barrier();
    const vec4 made = inside ? enlarged(pixel, level, cells) : vec4(0);
    barrier();
    return made;
}

// engine/waist/holdout.h
float let_through(ivec2 pixel, float nearest_px, float farthest_px) {
    const float nearest = nearest_px - kSameDepthPx, farthest = farthest_px - kSameDepthPx;
    const uint i = uint(pixel.y - int(at.held_rows)) * at.held_width + uint(pixel.x);
    float open = 1, from = nearest, sum = 0;
    for (uint s = holdout[i]; s < holdout[i + 1u]; ++s) {
        const float coc = uintBitsToFloat(holdout[at.held_samples + 2u * s]);
        if (coc >= farthest) break;
        if (coc > from) {
            sum += open * (coc - from);
            from = coc;
        }
        open *= 1 - uintBitsToFloat(holdout[at.held_samples + 2u * s + 1u]);
    }
    if (farthest <= nearest) return open;
    return (sum + open * (farthest - from)) / (farthest - nearest);
}

#define LAW_NUMBER float
#define LAW_FUNCTION
#define LAW_CHANGES inout float
#define LAW_OF(x) (x)
#define LAW_WHERE(x, a, b) ((x) > 0 ? (a) : (b))
#define LAW_LEAST(a, b) min(a, b)
#define LAW_MOST(a, b) max(a, b)
#include "laws/lens_left.inc"

// engine/samples/lens_left.h
struct LensLeft {
    float before, own, beside, more;
    int layer;
};
float free(LensLeft left) { return law_free(left.before, left.own); }
// The lens area taken, and the further area that side-by-side composition would take.
vec2 take(inout LensLeft left, float arrives, int layer) {
    law_meet(left.before, left.own, float(uint(layer) - uint(left.layer)));
    left.layer = layer;
    const float of_own = layer == kEmptyLayer ? law_of_what_is_left(left.before, arrives) : arrives;
    float area = 0, more = 0;
    law_take(left.before, left.own, left.beside, arrives, of_own, area, more);
    left.more += more;
    return vec2(area, more);
}

void main() {
    const uint tile = at.tiles + kTileWords * (gl_WorkGroupID.x / kGroupsOfTile), own = gl_LocalInvocationIndex;
    const uint sector = gl_WorkGroupID.y;
    if (sector >= plan[tile + 5u]) return;
    const ivec2 corner = ivec2(int(plan[tile]), int(plan[tile + 1u])),
                end = ivec2(int(plan[tile + 2u]), int(plan[tile + 3u]));
    const uint part = gl_WorkGroupID.x % kGroupsOfTile;
    Box box;
    box.low = corner + kSide * ivec2(part % kGroupsAcross, part / kGroupsAcross);
    box.high = min(box.low + kSide, end);
    if (any(greaterThanEqual(box.low, end))) return;
    const ivec2 pixel = box.low + corner_of_block(own / 32u) + ivec2(own % 8u, own / 8u % 4u);
    const bool inside = all(lessThan(pixel, box.high));

    vec4 sum = vec4(0), sum_of_more = vec4(0);
    LensLeft left = LensLeft(1, 0, 1, 0, 0);
    const uint last_layer = plan[tile + kTileWords + 4u];
    for (uint layer = plan[tile + 4u]; layer < last_layer; ++layer) {
        if (own == 0u) any_free = 0u;
        barrier();
        if (inside && free(left) >= kSpent) atomicOr(any_free, 1u);
        barrier();
        if (any_free == 0u) break;
        const uint word = at.layers + kLayerWords * (layer - at.first_layer);
        const uint begin = plan[word], middle = plan[word + 1u], close = plan[word + kLayerWords];
        vec4 light = vec4(0);
        float emptiness = 0;
        for (uint run = begin; run < close; ++run) {
            const vec4 more = arrived(run, sector, box, pixel, inside);
            if (run < middle) light += more;
            else emptiness += more.a;
        }
        const float arrives = light.a + emptiness;
        if (inside && arrives > 0) {
            const vec2 taken = take(left, arrives, int(plan[word + 4u]));
            float through = 1;
            if (kHeld != 0u)
                through = let_through(pixel, uintBitsToFloat(plan[word + 2u]), uintBitsToFloat(plan[word + 3u]));
            sum += light * (taken.x / arrives * through);
            sum_of_more += light * (taken.y / arrives * through);
        }
    }
    if (!inside) return;
    const uint pixel_of_tile = uint(pixel.y - corner.y) * kScatterTile + uint(pixel.x - corner.x);
    const uint place = plan[tile + 6u] + sector * kTilePixels + pixel_of_tile;
    const float share = law_share_of_more(free(left), left.beside, left.more);
    light_of[place] = sum + sum_of_more * share;
    taken_of[place] = law_taken(free(left), share, left.more);
}
