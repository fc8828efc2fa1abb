// Gathers 16 x 16 pixels of a tile: turn by turn (RingSizes::turns()), each from the light around that
// belongs to it. Formulas are device/cpu/gather.cpp's; the words are those that gather.cpp beside this writes.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "laws/compositing.h"
#include "laws/tiles.h"
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer KernelWords { uint kernels[]; };
layout(std430, binding = 2) readonly buffer Weights { float weights[]; };
layout(std430, binding = 3) writeonly buffer Result { vec4 result[]; };  // by tile, kGatherTile squared pixels each
layout(push_constant) uniform Push {
    uint tiles, levels, turns, places;  // where these begin in `words`
    uint turn_count, ring_count, records;
    uint is_opaque;   // alpha is coverage
    uint open_edges;  // bits: left, top, right, bottom
} at;

// A tile: its rectangle. A level: cells across and down, the first column and row that are here and how many of a
// row, where the first lights of its cells, the lights, and zones of columns and of rows that are here begin. A light: colour,
// covered, beyond, turn. A turn: its number, place among the kernels of a zone and level, and how far its kernels
// reach; then the same of its skirt, whose level is 0 where it has none; then 1 for a seam. Places: kernels by zone and ring.
const uint kTileWords = 4, kLevelWords = 9, kLightWords = 7, kTurnWords = 9, kEntryWords = 4, kNowhere = 0xffffffffu;
const int kChunk = kGroup;
const uint kTile = kGatherTile, kAcross = kTile / kGroupSide, kGroupsOfTile = kAcross * kAcross;

shared vec4 hit_colour[kChunk];  // and, when they are done, what cells hold
shared vec2 hit_area[kChunk];    // covered, beyond
shared int hit_x[kChunk], hit_y[kChunk];
shared uint hit_corner[kChunk], hit_size[kChunk], hit_weights[kChunk];
shared uint hit_words[kChunk / 32];

struct Box { ivec2 low, high; };
struct Sums {
    vec4 colour;
    vec2 area;
};

float number(uint word) { return uintBitsToFloat(words[word]); }

#include "kernels.glsl"

// Finds the lights of a turn, among those of cell number `index` of the window, that touch the box; returns
// their number.
uint find_hits(uint turn, uint level, Box window, Box box, int index) {
    const uint own = gl_LocalInvocationIndex;
    if (own < kChunk / 32) hit_words[own] = 0u;
    barrier();
    const ivec2 wide = window.high - window.low;
    const ivec2 place = window.low + ivec2(index % wide.x, index / wide.x);
    bool hits = false;
    uint light = 0u, record = 0u;
    const ivec2 size = ivec2(words[level], words[level + 1u]);
    const ivec2 cell = clamp(place, ivec2(0), size - 1);
    const uvec2 here = uvec2(cell - ivec2(words[level + 2u], words[level + 3u]));
    if (index < wide.x * wide.y) {
        const uint first = words[level + 5u] + here.y * words[level + 4u] + here.x;
        for (uint i = words[first]; i < words[first + 1u] && !hits; ++i) {
            light = words[level + 6u] + kLightWords * i;
            hits = words[light + 6u] == words[turn];
        }
    }
    if (hits) {
        const uint zone = words[words[level + 7u] + here.x] + words[words[level + 8u] + here.y];
        const uint kernel = words[at.places + zone * at.ring_count + words[turn + 1u]];
        hits = kernel != kNowhere;
        if (hits) {
            record = at.records + 3u * kernels[kernel];
            const ivec2 from = place + halves(kernels[record]);
            hits = all(lessThan(from, box.high)) && all(greaterThan(from + halves(kernels[record + 1u]), box.low));
        }
        if (hits) atomicOr(hit_words[own / 32u], 1u << (own % 32u));
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
        vec4 colour = vec4(number(light), number(light + 1u), number(light + 2u), number(light + 3u));
        vec2 area = vec2(number(light + 4u), number(light + 5u));
        // The continued picture beyond the border covers, in an unknown colour; otherwise there is emptiness.
        if (place != cell) {
            const bool goes_on = (place.x >= 0 || (at.open_edges & 1u) != 0u) &&
                                 (place.y >= 0 || (at.open_edges & 2u) != 0u) &&
                                 (place.x < size.x || (at.open_edges & 4u) != 0u) &&
                                 (place.y < size.y || (at.open_edges & 8u) != 0u);
            colour = vec4(0);
            area = goes_on ? vec2(0, area.x + area.y) : vec2(area.x + area.y, 0);
        }
        hit_colour[rank] = colour, hit_area[rank] = area;
        hit_x[rank] = place.x, hit_y[rank] = place.y;
        hit_corner[rank] = kernels[record], hit_size[rank] = kernels[record + 1u];
        hit_weights[rank] = kernels[record + 2u];
    }
    barrier();
    return all_hits;
}

// Light that arrives at a cell in one turn: from every hit whose number is `slice` of `slices`.
Sums gathered(uint turn, uint level, Box box, ivec2 cell, bool wanted, uint slice, uint slices) {
    const int reach = int(words[turn + 3u]);
    const Box window = Box(box.low - reach, box.high + reach);
    const ivec2 wide = window.high - window.low;
    Sums sums = Sums(vec4(0), vec2(0));
    for (int first = 0; first < wide.x * wide.y; first += kChunk) {
        const uint hits =
            find_hits(turn, level, window, box, first + int(gl_LocalInvocationIndex));
        if (wanted)
            for (uint k = slice; k < hits; k += slices) {
                const ivec2 d = cell - ivec2(hit_x[k], hit_y[k]) - halves(hit_corner[k]), size = halves(hit_size[k]);
                if (any(lessThan(d, ivec2(0))) || any(greaterThanEqual(d, size))) continue;
                const vec4 w = weight(d, size, hit_weights[k]);
                sums.colour += w * hit_colour[k];
                sums.area += w.a * hit_area[k];
            }
        barrier();
    }
    return sums;
}

// Takes the lens area that a turn arrives with, or the rest.
void take(Sums ring, inout vec4 sum, inout float free) {
    const bool covers = ring.area.x > kLeastGathered;
    const float taken = covers ? min(ring.area.x + ring.area.y, free) : 0.0;
    const float share = covers ? taken / ring.area.x : free;
    sum += share * vec4(ring.colour.rgb, at.is_opaque != 0u ? ring.area.x : ring.colour.a);
    free -= taken;
}

// The lens area that a seam (RingSizes::Turn) takes.
float seam_of(float area, float free) {
    const float covered = min(area, 1.0);
    return min(covered * min((1 - free) / max(1 - covered, kLeastGathered), 1.0), free);
}

// The cells of a level that these pixels need, as GatherPlan::cells_of().
Box cells_of(Box pixels, uint level) {
    return Box((pixels.low >> int(level)) - kGatherBorder, ((pixels.high - 1) >> int(level)) + 1 + kGatherBorder);
}

// Light that arrives at the cells of a box, row by row, one for each of the first invocations.
Sums gathered_in(uint entry, Box cells) {
    const uint own = gl_LocalInvocationIndex;
    const ivec2 size = cells.high - cells.low;
    const uint count = uint(size.x * size.y), slices = uint(kChunk) / count;
    const ivec2 cell = cells.low + ivec2(int(own % count) % size.x, int(own % count) / size.x);
    const Sums slice = gathered(entry, at.levels + kLevelWords * words[entry + 2u], cells, cell,
                                own < slices * count, own / count, slices);
    hit_colour[own] = slice.colour, hit_area[own] = slice.area;
    barrier();
    Sums whole = Sums(vec4(0), vec2(0));
    if (own < count)
        for (uint s = 0u; s < slices; ++s) {
            whole.colour += hit_colour[own + s * count];
            whole.area += hit_area[own + s * count];
        }
    barrier();
    return whole;
}

// Light of a turn's skirt at a place, in pixels: gathered on the skirt's level and enlarged.
Sums skirt_at(uint entry, Box pixels, vec2 place) {
    const uint own = gl_LocalInvocationIndex, level = words[entry + 2u];
    const Box cells = cells_of(pixels, level);
    const Sums whole = gathered_in(entry, cells);
    hit_colour[own] = whole.colour, hit_area[own] = whole.area;
    barrier();
    const ivec2 size = cells.high - cells.low;
    const vec2 from_low = place / float(1 << int(level)) - 0.5 - vec2(cells.low);
    const ivec2 low = clamp(ivec2(from_low), ivec2(0), size - 2);
    const vec2 t = from_low - vec2(low);
    const int i = low.y * size.x + low.x;
    const Sums sums = Sums(mix(mix(hit_colour[i], hit_colour[i + size.x], t.y),
                               mix(hit_colour[i + 1], hit_colour[i + size.x + 1], t.y), t.x),
                           mix(mix(hit_area[i], hit_area[i + size.x], t.y),
                               mix(hit_area[i + 1], hit_area[i + size.x + 1], t.y), t.x));
    barrier();
    return sums;
}

Sums with_skirt(Sums core, uint turn, Box pixels, vec2 place) {
    const uint skirt = turn + kEntryWords;
    if (words[skirt + 2u] == 0u) return core;
    const Sums more = skirt_at(skirt, pixels, place);
    return Sums(core.colour + more.colour, core.area + more.area);
}

void main() {
    const uint own = gl_LocalInvocationIndex, part = gl_WorkGroupID.x % kGroupsOfTile;
    const uint tile = at.tiles + kTileWords * (gl_WorkGroupID.x / kGroupsOfTile);
    const ivec2 corner = ivec2(int(words[tile]), int(words[tile + 1u])),
                end = ivec2(int(words[tile + 2u]), int(words[tile + 3u]));
    Box box;
    box.low = corner + 16 * ivec2(part % kAcross, part / kAcross);
    box.high = min(box.low + 16, end);
    if (any(greaterThanEqual(box.low, end))) return;
    const ivec2 pixel = box.low + ivec2(own % 16u, own / 16u);
    const bool inside = all(lessThan(pixel, box.high));

    vec4 sum = vec4(0);
    float free = 1;
    const uint last = at.turns + kTurnWords * at.turn_count;
    for (uint turn = at.turns; turn < last;) {
        const uint number_of_level = words[turn + 2u];
        if (number_of_level == 0u) {
            const Sums core = gathered(turn, at.levels, box, pixel, inside, 0u, 1u);
            take(with_skirt(core, turn, box, vec2(pixel) + 0.5), sum, free);
            turn += kTurnWords;
            continue;
        }
        // Rings of one level are combined on its grid and enlarged together.
        const Box cells = cells_of(box, number_of_level);
        const ivec2 size = cells.high - cells.low;
        const uint count = uint(size.x * size.y);
        const vec2 middle = vec2(cells.low + ivec2(int(own) % size.x, int(own) / size.x)) + 0.5;
        vec4 cell_sum = vec4(0);
        float cell_free = 1, seam = 0;
        for (; turn < last && words[turn + 2u] == number_of_level; turn += kTurnWords) {
            const Sums core = gathered_in(turn, cells);
            const Sums all = with_skirt(core, turn, box, middle * float(1 << int(number_of_level)));
            if (own >= count) continue;
            if (words[turn + 2u * kEntryWords] != 0u) {
                seam = seam_of(all.area.x + all.area.y, cell_free);
                cell_free -= seam;
            } else {
                take(all, cell_sum, cell_free);
            }
        }
        hit_colour[own] = cell_sum, hit_area[own] = vec2(cell_free + seam, 0);
        barrier();
        if (inside) {
            const vec2 place = (vec2(pixel) + 0.5) / float(1 << int(number_of_level)) - 0.5 - vec2(cells.low);
            const ivec2 low = ivec2(place);
            const vec2 t = place - vec2(low);
            const int i = low.y * size.x + low.x;
            const vec4 colour = mix(mix(hit_colour[i], hit_colour[i + size.x], t.y),
                                    mix(hit_colour[i + 1], hit_colour[i + size.x + 1], t.y), t.x);
            const float area = 1 - mix(mix(hit_area[i].x, hit_area[i + size.x].x, t.y),
                                       mix(hit_area[i + 1].x, hit_area[i + size.x + 1].x, t.y), t.x);
            const bool covers = area > kLeastGathered;
            const float taken = covers ? min(area, free) : 0.0;
            sum += (covers ? taken / area : free) * colour;
            free -= taken;
        }
        barrier();
    }
    const float taken = 1 - free;
    if (!inside) return;
    const uvec2 place = uvec2(pixel - corner);
    result[(gl_WorkGroupID.x / kGroupsOfTile * kTile + place.y) * kTile + place.x] =
        sum * (taken > kLeastGathered ? 1 / taken : 0.0);
}
