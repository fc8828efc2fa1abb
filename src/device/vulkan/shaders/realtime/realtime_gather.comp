// Gathers one cell: light in focus and behind it over the cell's own radius, light in front of focus over the largest
// radius that reaches its tile.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray cells;
layout(std430, binding = 1) readonly buffer Lens { vec4 lens[]; };  // engine/gather/realtime_plan.h
layout(std430, binding = 2) readonly buffer Reach { vec4 reach[]; };  // realtime_reach.comp
layout(binding = 3, rgba16f) writeonly uniform image2DArray gathered;
#include "realtime.glsl"

const float kLeastArea = 1e-4;
const float kCovers = 0.9995;  // a share of near light that hides what is behind
const float kNearestPx = 4, kFarther = 1.5;  // where what is hidden is looked for: first, and then each time as far

int first_tap, taps;              // of the cell's own spiral; their number
int first_weight;                 // of this spiral in the cell's zone, in front of focus
int first_grid, grid_weight;      // the same of whole cells
int far_side;                     // from a weight in front of focus to that behind it
float tap_side;                   // of the square that a tap reads on a disc of radius 1
vec2 texel;                       // size of a cell
vec2 farthest;                    // where cells around the frame end
const float kMostShare = float(kShares - 1);
// A disc of cells: reads at middle + tap * scale, from this level.
struct Disc {
    vec2 middle, scale;
    float level;
    int tap, end, weights;  // its first tap, the one after its last, the weights of the first in front of focus
    float per_px, least, most;  // weights in a pixel of radius; those of half a pixel and of the disc's radius, half a weight up
};
// Small discs take whole cells, wider ones a spiral of taps (engine/gather/realtime_plan.h).
Disc disc_of(vec2 middle, float radius_px) {
    const float grid_px = 2 * lens[first_grid + kGridTaps - 1].w;
    const vec2 scale = 0.5 * vec2(1, at.aspect) * texel;
    if (radius_px <= grid_px) {
        const int count = int(lens[first_grid + int(4 * radius_px)].w);
        const float per_px = kMostShare / grid_px;
        return Disc(middle * texel, grid_px * scale, 0, first_grid, first_grid + count, grid_weight, per_px, 0.5 * per_px + 0.5, per_px * radius_px + 0.5);
    }
    const float level = max(0.0, log2(0.5 * radius_px * tap_side));
    const float per_px = kMostShare / radius_px;
    return Disc(middle * texel, radius_px * scale, level, first_tap, first_tap + taps, first_weight, per_px, 0.5 * per_px + 0.5, kMostShare + 0.5);
}
// Weight of a tap for light of this radius: the lens's shape, normalised so that a plane keeps its light. first_of: where
// the tap's weights begin.
vec4 weight_of(Disc disc, int first_of, float radius_px) {
    return lens[first_of + int(clamp(radius_px * disc.per_px + 0.5, disc.least, disc.most))];
}

// Mean radius of the light in front of focus in a cell, and behind it.
float near_radius(vec3 near) { return near.y / max(near.z, 1e-7); }
float back_radius(vec4 back) { return back.y / max(back.w, 1e-7); }

// The growth of the radius over a surface that recedes, in pixels a pixel; 0 where a cell beside it is another surface.
// The lens sees more of such a surface from one side than from the other: light that a cell receives comes from a place
// nearer to the cell by radius * slope / 4 than the middle of all discs that reach it. kShift: in cells, as measured.
const float kShift = 0.15;
vec2 slope_of(ivec2 cell, int layer, float own_px) {
    const ivec2 last = 8 * at.tiles - 1;
    const vec4 right = texelFetch(cells, ivec3(min(cell + ivec2(1, 0), last), layer), 0);
    const vec4 below = texelFetch(cells, ivec3(min(cell + ivec2(0, 1), last), layer), 0);
    const vec2 radii = layer == kBack ? vec2(back_radius(right), back_radius(below)) : vec2(near_radius(right.xyz), near_radius(below.xyz));
    const vec2 slope = 0.5 * (radii - own_px);
    return dot(slope, slope) < 0.09 ? slope * smoothstep(3.0, 5.0, own_px) : vec2(0);
}

// Sums taps over a disc: of light as blurred as a cell of `own_px`, of light blurred far less, or of light blurred far
// more; and the largest radii of the last two.
const float kLessBlurred = 0.4, kAsBlurred = 0.7, kUpTo = 1.2, kMoreBlurred = 1.7;  // of the cell's radius
const float kSame = 0.98;  // of the disc's radius
const int kAlike = 0, kLess = 1, kMore = 2;
struct Sum {
    vec4 light;
    float area, more_area;  // that of light blurred far more within the same disc
    float less_px, more_px;
};
Sum back_over(vec2 middle, float radius, float own_px, int which) {
    const Disc disc = disc_of(middle, radius);
    const float per_own = 1 / own_px;
    Sum sum = Sum(vec4(0), 0, 0, 0, 0);
    vec2 less_sum = vec2(0);
    int first_of = disc.weights + far_side;
    // Most light is about as blurred as the cell: from kSame of the disc's radius to kUpTo of the cell's it has the weight of
    // the disc's radius, and needs no division.
    const float low_px = kSame * radius, alike_px = 0.5 * (kUpTo * own_px + low_px), within_px = alike_px - low_px;
    const int own_weight = int(disc.most);
    for (int i = disc.tap; i < disc.end; ++i, first_of += kShares) {
        const vec2 place = disc.middle + lens[i].xy * disc.scale;
        const vec4 there = textureLod(cells, vec3(place, kBack), disc.level);
        const vec4 light = textureLod(cells, vec3(place, kBackLight), disc.level);
        vec4 w;
        if (which == kAlike && abs(there.y - alike_px * there.w) <= within_px * there.w) {
            w = lens[first_of + own_weight];
            sum.light += w * light;
            sum.area += w.a * there.x;
            continue;
        }
        // Empty places were left above.
        const float reaches = which == kAlike ? there.y / there.w : back_radius(there), ratio = reaches * per_own;
        if (ratio < kAsBlurred) {
            const float less = ramp(kAsBlurred, kLessBlurred, ratio);
            if (there.x > 0.01) less_sum += less * there.x * vec2(1, reaches * reaches);
            const float counts = which == kLess ? less : (which == kAlike ? 1 - less : 0.0);
            if (counts == 0) continue;
            w = counts * weight_of(disc, first_of, reaches);
        } else if (ratio > kUpTo) {
            const float more = ramp(kUpTo, kMoreBlurred, ratio);
            if (which == kLess || (which == kMore && more == 0)) continue;
            w = weight_of(disc, first_of, reaches);
            if (which == kAlike) {
                if (there.x > 0.01) sum.more_px = max(sum.more_px, reaches);
                sum.more_area += more * w.a * there.x;
            }
            w *= which == kMore ? more : 1 - more;
        } else {
            if (which != kAlike) continue;
            w = weight_of(disc, first_of, reaches);
        }
        sum.light += w * light;
        sum.area += w.a * there.x;
    }
    // The mean and not the largest, because a mixed cell beside a silhouette has a radius between both surfaces'.
    if (less_sum.x > 0) sum.less_px = min(1.2 * sqrt(less_sum.y / less_sum.x), kAsBlurred * own_px);
    return sum;
}
// Blurs the light behind focus as a cell of this radius sees it, in three layers. The cell's own disc is the opening
// through which far more blurred light is seen, which comes from as far as its own radius. Far less blurred light has
// only a few taps in that disc: it is gathered over its own reach, and lies on top.
vec4 back_of(vec2 middle, vec4 own_light, float own_px, vec2 slope, out float area) {
    const float radius = max(own_px, 1.0);
    // On a surface that recedes, the disc covers the place that its light comes from.
    const Sum own = back_over(middle - kShift * radius * slope, (1 + length(slope)) * radius, radius, kAlike);
    area = own.area + own.more_area;
    vec4 light = own.area > 0 ? own.light * (1 / own.area) : own_light;
    if (own.more_area > 0 && own.more_px > 0) {
        const Sum more = back_over(middle, own.more_px, radius, kMore);
        if (more.area > 0) light = mix(light, more.light * (1 / more.area), own.more_area / area);
    }
    if (own.less_px > 0) {
        const Sum less = back_over(middle, max(own.less_px, 1.0), radius, kLess);
        light = less.area < 1 ? less.light + (1 - less.area) * light : less.light * (1 / less.area);
    }
    return light;
}

// The nearest background in a direction from a cell in front of focus: light behind focus, or in front of it and blurred
// far less. Bright light gets little weight, because nothing bright is assumed to be hidden.
struct End {
    vec4 light;
    float away, likely, back_px, back_area;  // pixels; 0: none was found; sums of the light behind focus
};
End end_of(vec2 middle, vec2 way, float own_px, float most_px) {
    const vec2 from = middle * texel, per_px = 0.5 * way * vec2(1, at.aspect) * texel;
    const float most_near_px = 0.6 * own_px;
    End end = End(vec4(0), 0, 0, 0, 0);
    float open = 1, away = min(kNearestPx, most_px), level = log2(away / 8);
    for (; open > 0.05; away *= kFarther, level += log2(kFarther)) {
        const vec3 place = vec3(min(from + away * per_px, farthest), kBack);
        const vec4 back = textureLod(cells, place, level), near = textureLod(cells, vec3(place.xy, kNear), level);
        float behind = 0;
        if (near.x > kLeastArea && near.y < most_near_px * near.z) behind = ramp(0.6, 0.4, near_radius(near.xyz) / own_px);
        const float area = back.z + behind * near.w, all = back.z + (behind > 0 ? near.w : 0.0);
        if (all > 0.5) {
            const float shows = open * ramp(0.5, 1.0, all) * (area / all);
            vec4 light = vec4(0);
            if (back.z > kLeastArea) light += textureLod(cells, vec3(place.xy, kBackLight), level) * (back.z / back.x);
            if (behind > 0) light += textureLod(cells, vec3(place.xy, kNearLight), level) * (behind * near.w / near.x);
            end.light += shows / area * light;
            end.away += shows * away;
            end.likely += shows;
            end.back_px += shows * back.z * back_radius(back), end.back_area += shows * back.z;
            open -= shows;
        }
        if (away >= 2 * most_px) break;
    }
    if (end.likely == 0) return end;
    const float per_likely = 1 / end.likely;
    end.light *= per_likely, end.away *= per_likely;
    end.likely /= 1 + 0.3 * at.exposure * brightness(end.light);
    return end;
}

// Background of a cell completely in front of focus, from the ends of four lines through it: the mean of ends, those
// that are alike and close first. Where back light is blurred, it is light gathered over the radius that it has there.
vec4 hidden_of(vec2 middle, float own_px, float most_px, out float is_known) {
    vec4 light = vec4(0);
    float area = 0, back_area = 0, back_px = 0;
    [[dont_unroll]] for (int axis = 0; axis < 4; ++axis) {
        const vec2 way = axis == 0 ? vec2(1, 0) : vec2(axis - 2, 1) * (axis == 2 ? 1.0 : 0.7071);
        const End one = end_of(middle, way, own_px, most_px), other = end_of(middle, -way, own_px, most_px);
        const vec2 w = weights_of(one.light, other.light, vec2(one.away, other.away), vec2(one.likely, other.likely));
        light += w.x * one.light + w.y * other.light, area += w.x + w.y;
        back_px += dot(w, vec2(one.back_px, other.back_px));
        back_area += dot(w, vec2(one.back_area, other.back_area));
    }
    is_known = area > 0 ? 1.0 : 0.0;
    const vec4 mean = area > 0 ? light / area : vec4(0);
    const float around_px = back_px / max(back_area, 1e-9), blurred = smoothstep(2.0, 4.0, around_px) * smoothstep(4.0, 12.0, own_px);
    if (blurred == 0) return mean;
    float seen;
    const vec4 gathered = back_of(middle, mean, around_px, vec2(0), seen);
    return mix(mean, gathered, blurred * smoothstep(0.0, 0.1, seen));
}

// Sums taps over a disc in front of focus: light blurred far less than the most that reaches the tile, or the rest.
const float kNearLess = 0.5, kNearLeast = 0.3;  // of the most
struct NearSum {
    vec4 light;
    vec2 area;      // of all of it; of that so little blurred that a part of it is blurred pixel by pixel
    float less_px;  // radius of light blurred far less around the cell
};
NearSum near_over(vec2 middle, float radius, float most_px, bool is_less) {
    const Disc disc = disc_of(middle, radius);
    const float per_most = 1 / most_px;
    NearSum sum = NearSum(vec4(0), vec2(0), 0);
    vec2 less_sum = vec2(0);
    int first_of = disc.weights;
    for (int i = disc.tap; i < disc.end; ++i, first_of += kShares) {
        const vec3 tap = lens[i].xyz;
        const vec2 place = disc.middle + tap.xy * disc.scale;
        const vec3 there = textureLod(cells, vec3(place, kNear), disc.level).xyz;
        if (there.x < kLeastArea) continue;
        const float reaches = near_radius(there), ratio = reaches * per_most;
        vec4 w;
        if (ratio < kNearLess) {
            const float less = ramp(kNearLess, kNearLeast, ratio);
            if (tap.z * kMostShare < (ratio + 0.15) * disc.most) less_sum += less * there.x * vec2(1, reaches * reaches);
            const float counts = is_less ? less : 1 - less;
            if (counts == 0) continue;
            w = counts * weight_of(disc, first_of, reaches);
        } else {
            if (is_less) continue;
            w = weight_of(disc, first_of, reaches);
        }
        if (w.a == 0) continue;
        sum.light += w * textureLod(cells, vec3(place, kNearLight), disc.level);
        const float area = w.a * there.x;
        sum.area.x += area;
        if (reaches < kWholePx) sum.area.y += area * min(kWholePx - reaches, 1.0);
    }
    if (less_sum.x > 0) sum.less_px = min(1.2 * sqrt(less_sum.y / less_sum.x), kNearLess * most_px);
    return sum;
}
// Light blurred far less than a nearer surface has only a few taps in that surface's disc. It is gathered over its own
// radius, and seen past that surface.
vec4 near_of(vec2 middle, float radius, out vec2 area) {
    NearSum near = near_over(middle, radius, radius, false);
    if (near.less_px > 0) {
        const NearSum less = near_over(middle, max(near.less_px, 1.0), radius, true);
        const float shows = near.area.x + less.area.x > 1 ? max(1 - near.area.x, 0.0) / max(less.area.x, 1e-6) : 1.0;
        near.light += shows * less.light;
        near.area += shows * less.area;
    }
    area = near.area;
    return near.light;
}

void main() {
    const ivec2 cell = ivec2(gl_GlobalInvocationID.xy), tile = ivec2(gl_WorkGroupID.xy);
    const float near_px = reach[tile.y * at.tiles.x + tile.x].x;
    const vec2 middle = vec2(cell) + 0.5;
    const vec4 head = lens[0];
    taps = int(head.x), tap_side = head.y;
    const int set = (cell.x & 1) + 2 * (cell.y & 1);
    first_tap = 1 + taps * set;
    first_grid = 1 + kSpirals * taps;
    far_side = kShares * all_taps_of(head);
    texel = 0.125 / vec2(at.tiles);
    farthest = farthest_place(texel);
    // Each set takes the nearest zone of another fraction, so that the mean of the four interpolates between zones.
    const vec2 fraction = (vec2(set, (set & 1) * 2 + (set >> 1)) + 0.5) / float(kSpirals);
    const ivec2 zone = ivec2(zone_place(2 * middle, head.zw) + fraction);
    const int first_of_zone = first_zone_of(head) + size_of_zone(head) * (zone.y * int(head.z) + zone.x);
    first_weight = first_of_zone + kShares * taps * set;
    grid_weight = first_of_zone + kShares * kSpirals * taps;
    const vec4 own = texelFetch(cells, ivec3(cell, kBack), 0);
    const bool has = own.z > 0.02;
    const vec3 own_near = texelFetch(cells, ivec3(cell, kNear), 0).xyz;
    vec2 area = vec2(0);
    vec4 near = vec4(0);
    if (near_px > 0.5) {
        const float own_px = near_radius(own_near);
        const vec2 slope = own_near.x > 0.99 ? slope_of(cell, kNear, own_px) : vec2(0);
        near = near_of(middle - kShift * own_px * slope, max(near_px, 1.0), area);
    }
    vec4 back = vec4(0);
    float is_known = 1;
    if (area.x >= kCovers) {
        is_known = 0;
    } else if (has) {
        const vec4 own_light = texelFetch(cells, ivec3(cell, kBackLight), 0) * (1 / own.x);
        float seen;
        back = back_radius(own) < 0.5 ? own_light : back_of(middle, own_light, back_radius(own), slope_of(cell, kBack, back_radius(own)), seen);
    } else {
        back = hidden_of(middle, near_radius(own_near), max(near_px, 1.0), is_known);
    }
    imageStore(gathered, ivec3(cell, kGatheredBack), back);
    imageStore(gathered, ivec3(cell, kGatheredNear), near);
    const float own_px = has ? back_radius(own) : 0.0;
    imageStore(gathered, ivec3(cell, kGatheredArea), vec4(area.x, own_px, is_known, area.y));
}
