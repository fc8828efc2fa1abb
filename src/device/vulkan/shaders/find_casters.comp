// The occluders that a viewpoint sees, in order: a group takes those of its ranges that cover a part of the pupil
// (engine/lights/shadow_plan.h), and counts them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "laws/casters.h"
#include "laws/tiles.h"
layout(local_size_x = 256) in;

struct Caster { float x, y, size, coc_px, coverage, right_px, down_px; };
struct SeenCaster { float u, v, wide, tall, blur, coverage; };

layout(std430, binding = 0) buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Casters { Caster casters[]; };
layout(std430, binding = 2) writeonly buffer Seen { SeenCaster seen[]; };
layout(push_constant) uniform Push {
    uint views, searches, ranges;     // where these begin in `words`
    float left, top, right, bottom;  // OpenSides
} at;

// A search: first range, ranges, casters in them, then its viewpoint: x, y, radius, size, 1: is shown, and the
// pupil's end. A range: its first caster, and how many of the search come before.
const uint kViewWords = 7, kSearchWords = 9, kRangeWords = 2;

struct Viewpoint { float x, y, coc_px; int size; bool is_shown; };
struct OpenSides { float left, top, right, bottom; };

#define LAW_NUMBER float
#define LAW_TRUTH bool
#define LAW_FUNCTION
#define LAW_CHANGES inout float
#define LAW_OF(x) (x)
#define LAW_LESS(a, b) ((a) < (b))
#define LAW_SAME(a, b) ((a) == (b))
#define LAW_BOTH(a, b) ((a) && (b))
#define LAW_NOT(a) (!(a))
#define LAW_WHERE(c, a, b) ((c) ? (a) : (b))
#define LAW_LEAST(a, b) min(a, b)
#define LAW_MOST(a, b) max(a, b)
#define LAW_CASTER Caster
#define LAW_VIEWPOINT Viewpoint
#define LAW_EDGES OpenSides
#define LAW_SEEN inout SeenCaster
#include "laws/seen_caster.inc"

#include "ranks.glsl"

// Caster number i of a search.
Caster caster_of(uint search, uint i) {
    uint low = words[search], count = words[search + 1u];
    for (; count > 1u; count -= count / 2u) {
        const uint middle = low + count / 2u;
        if (words[at.ranges + kRangeWords * middle + 1u] <= i) low = middle;
    }
    const uint range = at.ranges + kRangeWords * low;
    return casters[words[range] + i - words[range + 1u]];
}

void main() {
    const uint search = at.searches + kSearchWords * gl_WorkGroupID.x, view = at.views + kViewWords * gl_WorkGroupID.x;
    const uint count = words[search + 2u], first = words[view];
    const Viewpoint from = Viewpoint(uintBitsToFloat(words[search + 3u]), uintBitsToFloat(words[search + 4u]),
                                     uintBitsToFloat(words[search + 5u]), int(words[search + 6u]),
                                     words[search + 7u] != 0u);
    const float pupil_end = uintBitsToFloat(words[search + 8u]);
    const OpenSides edges = OpenSides(at.left, at.top, at.right, at.bottom);
    uint all = 0u;
    for (uint done = 0u; done < count; done += kGroup) {
        const uint i = done + gl_LocalInvocationIndex;
        SeenCaster found;
        bool sees = i < count;
        if (sees) sees = law_sees(caster_of(search, i), from, edges, pupil_end, found);
        const uvec2 rank = ranked(sees);
        if (sees) seen[first + all + rank.x] = found;
        all += rank.y;
    }
    if (gl_LocalInvocationIndex == 0u) words[view + 1u] = all;
}
