// A pixel of the result. RESULT: the format of its image.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2DArray cells;
layout(binding = 2) uniform sampler2D over;  // the host's transparent layer, premultiplied
layout(binding = 3) uniform sampler2DArray gathered;
layout(binding = 4, RESULT) writeonly uniform image2D result;
layout(std430, binding = 8) readonly buffer Reach { vec4 reach[]; };  // realtime_reach.comp
#include "realtime.glsl"

float radius_at(ivec2 pixel) {
    return texelFetch(cells, ivec3(pixel / 2, kRadii), 0)[(pixel.y & 1) * 2 + (pixel.x & 1)];
}
#include "realtime_sprites.glsl"

// Sums blurs too fine for cells of two pixels: a pixel and those around it, each over a disc of its radius, from a window
// that the group reads once. Background is seen through the pixel's own disc.
const int kRim = 3, kAcross = 8 + 2 * kRim, kSquare = 2 * kRim + 1;  // pixels
shared vec4 window[kAcross * kAcross];
shared vec2 window_discs[kAcross * kAcross];  // signed reach, at least half a pixel; light that a pixel of the disc gets
shared uint widest_px[2];  // as bits, of pixels in the window that are blurred pixel by pixel: behind focus, in front of it
const int kToRight = kRim * kSquare + kRim + 1;
shared float inside[kSquare * kSquare];  // by offset, from (-kRim, -kRim): half a pixel less the distance
float of_each(float radius_px) {
    return (1 - blurred_share(radius_px)) / max(1.0, 3.14159 * radius_px * radius_px);
}
// A disc covers a pixel half at this distance between their middles, with the radius's sign: a circle's rim bends away
// from a square's side.
float reach_of(float radius) {
    const float all = max(abs(radius), 0.5), reach = max(all - 1 / (24 * all), 0.5);
    return radius < 0 ? -reach : reach;
}
// Reads the window; all invocations of the group call it together.
void read_window() {
    const int own = int(gl_LocalInvocationIndex);
    const ivec2 first = 8 * ivec2(gl_WorkGroupID.xy) - kRim;
    vec2 widest = vec2(0);
    if (own < 2) widest_px[own] = 0u;
    for (int i = own; i < kAcross * kAcross; i += 64) {
        const ivec2 there = clamp(first + ivec2(i % kAcross, i / kAcross), ivec2(0), at.size - 1);
        const float radius = radius_at(there);
        window[i] = finite_of(texelFetch(colours, there, 0));
        window_discs[i] = vec2(reach_of(radius), of_each(abs(radius)));
        widest = max(widest, vec2(pixelwise(radius), pixelwise(-radius)));
    }
    barrier();
    for (int i = 0; i < 2; ++i)
        if (widest[i] > 0) atomicMax(widest_px[i], floatBitsToUint(widest[i]));
    if (own < kSquare * kSquare) inside[own] = 0.5 - length(vec2(own % kSquare - kRim, float(own / kSquare - kRim) / at.aspect));
}
// Offsets of pixels that a disc reaches.
int last_offset(float radius_px) { return min(int(ceil(max(radius_px, 0.5) + 0.5)) - 1, kRim); }

// The nearest background in a direction from a pixel: farther than a near surface, and within the window. Nothing bright is
// assumed to be hidden.
struct End {
    vec4 light;
    float away, likely;  // pixels; 0: none was found
    float sharp, disc;   // share that is blurred pixel by pixel; signed reach
};
End end_of(int own, int along, float step_px, float near_px) {
    for (int i = 1; i <= kRim; ++i) {
        const int there = own + i * along;
        const float there_px = window_discs[there].x, farther = smoothstep(0.8, 0.6, there_px / near_px);
        if (farther == 0) continue;
        const vec4 light = window[there];
        return End(light, float(i) * step_px, farther / (1 + at.exposure * brightness(light)), 1 - blurred_share(abs(there_px)), there_px);
    }
    return End(vec4(0), 1, 0, 0, 0);
}
// Background behind a near surface of this radius, between the two ends of four lines through a pixel. Ends that are alike
// and close count most, so edges and textures continue behind a thin surface. A line with one end is a last resort. Beside a
// lamp, the darker end of a line decides.
struct Behind {
    vec4 light;
    float sharp, disc, area;  // as in End; 0: nothing was found
};
Behind behind_at(int own, float near_px) {
    Behind sum = Behind(vec4(0), 0, 0, 0);
    [[dont_unroll]] for (int axis = 0; axis < 4; ++axis) {
        const int along = axis == 0 ? 1 : kAcross + axis - 2;
        const float step_px = 0.5 - inside[axis == 0 ? kToRight : kToRight + kSquare - 3 + axis];
        const End one = end_of(own, along, step_px, near_px), other = end_of(own, -along, step_px, near_px);
        const vec2 bright = vec2(brightness(one.light), brightness(other.light));
        vec2 w = weights_of(one.light, other.light, vec2(one.away, other.away), vec2(one.likely, other.likely));
        if (min(w.x, w.y) > 0) w *= min(vec2(1), 4 * bright.yx / max(bright, vec2(1e-6)));
        const vec2 w_sharp = w * vec2(one.sharp, other.sharp);
        sum.light += w.x * one.light + w.y * other.light;
        sum.disc += dot(w_sharp, vec2(one.disc, other.disc));
        sum.sharp += w_sharp.x + w_sharp.y;
        sum.area += w.x + w.y;
    }
    if (sum.sharp > 0) sum.disc /= sum.sharp;
    if (sum.area > 0) sum.light /= sum.area, sum.sharp /= sum.area;
    return sum;
}
// The light of a pixel beside a near surface, without that surface's part of it. The pixel shows some of it although its
// depth is the background's: at most half.
vec4 without_near(int own, float radius) {
    const vec4 light = window[own];
    if (abs(radius) >= kWholePx) return light;
    vec4 near = vec4(0);
    float nearest = 0, area = 0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const int there = own + y * kAcross + x;
            const float there_px = window_discs[there].x;
            if (there_px > -kWholePx) continue;
            near += window[there], area += 1;
            nearest = min(nearest, there_px);
        }
    if (area == 0) return light;
    const Behind behind = behind_at(own, nearest);
    if (behind.area == 0) return light;
    const vec4 apart = near / area - behind.light;
    const float share = dot((light - behind.light).rgb, apart.rgb) / max(dot(apart.rgb, apart.rgb), 1e-9);
    return max(light - clamp(share, 0.0, 0.5) * apart, vec4(0));
}

struct Fine {
    vec4 back, near;
    float back_area, area;  // of what is behind focus or taken for it, 0: `back` is sharp; of what is in front
};
// Removes the near surface from the picture in the window. Returns the signed radius of the surface behind it. All
// invocations of the group call it together.
float reveal(int own, float radius) {
    const vec4 light = without_near(own, radius);
    barrier();
    window[own] = light;
    barrier();
    Behind behind = Behind(vec4(0), 0, 0, 0);
    if (radius <= -kWholePx) behind = behind_at(own, radius);
    barrier();
    if (behind.sharp > 0) {
        window[own] = behind.light;
        window_discs[own] = vec2(behind.disc, behind.sharp * of_each(abs(behind.disc)));
        radius = behind.disc;
    }
    barrier();
    return radius;
}
Fine fine(float radius, float back_px, float near_px, bool has_near) {
    const int own = (int(gl_LocalInvocationID.y) + kRim) * kAcross + int(gl_LocalInvocationID.x) + kRim;
    if (has_near) radius = reveal(own, radius);
    Fine sum = Fine(window[own], vec4(0), 0, 0);
    vec4 back = vec4(0);
    float back_area = 0;
    const float opening = reach_of(max(radius, 0.0)), of_opening = of_each(max(radius, 0.0));
    int far = last_offset(back_px);
    for (int y = -far; y <= far; ++y) {
        int there = own + y * kAcross - far, i = (y + kRim) * kSquare + kRim - far;
        for (const int last = there + 2 * far; there <= last; ++there, ++i) {
            const vec2 disc = window_discs[there];
            const float area = clamp(min(disc.x, opening) + inside[i], 0.0, 1.0) * max(disc.y, of_opening);
            back += area * window[there];
            back_area += area;
        }
    }
    far = last_offset(near_px);  // 0: what is in focus, a little before it
    for (int y = -far; y <= far; ++y) {
        int there = own + y * kAcross - far, i = (y + kRim) * kSquare + kRim - far;
        for (const int last = there + 2 * far; there <= last; ++there, ++i) {
            const vec2 disc = window_discs[there];
            const float area = disc.y * clamp(inside[i] - disc.x, 0.0, 1.0);
            sum.near += area * window[there];
            sum.area += area;
        }
    }
    if (back_area > 1e-3) {
        sum.back = back / back_area;
        sum.back_area = min(back_area, 1.0);
    } else if (radius < 0 && radius > -kWholePx) {  // wider ones keep what cells found, or groups would show
        const Behind behind = behind_at(own, radius);
        if (behind.area > 0) sum.back = behind.light, sum.back_area = behind.sharp;
        else if (sum.area > 0) sum.back = sum.near / sum.area;
    }
    // The covered area of a disc, counted pixel by pixel, is right to 4 %.
    if (sum.area > 1) sum.near /= sum.area, sum.area = 1;
    return sum;
}

// Interpolates back light between the four cells around the pixel; near focus, cells as blurred as the pixel count first.
vec4 back_at(ivec2 pixel, float radius, out float is_known) {
    const vec2 place = (vec2(pixel) + 0.5) * 0.5 - 0.5;
    const ivec2 low = ivec2(floor(place)), last = 8 * at.tiles - 1;
    const vec2 share = place - vec2(low);
    vec4 sum = vec4(0);
    float weights = 0;
    for (int i = 0; i < 4; ++i) {
        const ivec2 d = ivec2(i & 1, i >> 1), cell = clamp(low + d, ivec2(0), last);
        const vec4 area = texelFetch(gathered, ivec3(cell, kGatheredArea), 0);
        // Four cells have the taps of four sets: a wide disc shows the mean of them, also one behind a near surface.
        const vec2 near_it = mix(mix(1 - share, share, vec2(d)), vec2(0.5), smoothstep(16.0, 40.0, abs(radius)));
        const float own = gathered_radius(radius);
        float alike = radius > 0 ? exp2(-4 * abs(area.y - own) / (1 + 0.5 * radius)) : 1.0;
        // If neither the pixel nor the cell is nearly sharp, both know the light between them.
        alike = mix(alike, 1.0, smoothstep(1.0, 2.5, min(own, area.y)));
        const float w = near_it.x * near_it.y * area.z * max(alike, 1e-4);
        sum += w * texelFetch(gathered, ivec3(cell, kGatheredBack), 0);
        weights += w;
    }
    is_known = weights > 1e-6 ? 1.0 : 0.0;
    return weights > 1e-6 ? sum / weights : vec4(0);
}

// The view that a host asked for.
vec4 viewed(vec4 made, float radius, vec4 reaches, vec4 behind, vec4 before, vec4 lamps) {
    const float share = min(abs(radius) / at.most_px, 1.0);
    if (at.view == 1u) return vec4(radius < 0 ? share : 0.0, abs(radius) < 0.5 ? 0.25 : 0.0, radius > 0 ? share : 0.0, 1);
    if (at.view == 2u) return vec4(behind.rgb, 1);
    if (at.view == 3u) return before;
    if (at.view == 4u) return vec4(lamps.rgb, 1);
    if (at.view == 5u) return vec4(reaches.x / at.most_px, max(reaches.y, reaches.z) / kWholePx, 0, 1);
    return made;
}

void main() {
    // A group runs as a whole or not at all, because its invocations look for lamps together.
    const ivec2 place_of_group = ivec2(gl_GlobalInvocationID.xy), pixel = min(place_of_group, at.size - 1);
    const vec2 place = (vec2(pixel) + 0.5) * 0.5 / vec2(8 * at.tiles);
    const ivec2 tile = 8 * ivec2(gl_WorkGroupID.xy) / kTile;
    const float radius = radius_at(pixel);
    const vec4 reaches = reach[tile.y * at.tiles.x + tile.x];
    const bool has_near = reaches.w < -2, is_fine = max(reaches.y, reaches.z) > (has_near ? 0.0 : 0.5);
    if (is_fine) read_window();
    barrier();
    Fine own = Fine(finite_of(texelFetch(colours, pixel, 0)), vec4(0), 0, 0);
    if (is_fine) own = fine(radius, uintBitsToFloat(widest_px[0]), uintBitsToFloat(widest_px[1]), has_near);
    const float hidden = blurred_share(-radius), blurred = blurred_share(abs(radius));
    vec4 near_lamps = vec4(0), back_lamps = vec4(0);
    add_all_lamps(pixel, reaches.x, near_lamps, back_lamps);
    vec4 near = vec4(0);
    float area = 0, fine_area = 0, is_known = 1;
    if (reaches.x > 0.5) {
        const vec2 half_cell = 0.5 * smoothstep(4.0, 12.0, reaches.x) / vec2(8 * at.tiles);
        for (int i = 0; i < 4; ++i) {
            const vec2 there = place + half_cell * (2 * vec2(i & 1, i >> 1) - 1);
            near += 0.25 * textureLod(gathered, vec3(there, kGatheredNear), 0);
            const vec4 areas = textureLod(gathered, vec3(there, kGatheredArea), 0);
            area += 0.25 * areas.x;
            fine_area += 0.25 * areas.w;
        }
    }
    // A completely near pixel has no sharp part; some of its background may be known.
    vec4 base = own.back;
    if (blurred > 0) {
        const vec4 back = back_at(pixel, radius, is_known);
        // Light drawn pixel by pixel leaves the rest of the pixel's lens to cells, whichever pixel it comes from.
        base = mix(base, back, is_known * min(blurred, 1 - own.back_area));
    }
    const bool fills = area > 0 && is_known == 0 && hidden > 0.99;
    const float covers = fills ? 1.0 : min(area, 1.0);
    // Near light that pixels and cells both draw in part is one surface: the parts lie side by side.
    const float free = 1 - covers, open = min(free + min(fine_area, covers), own.area > 0 ? free / own.area : 1.0);
    vec4 made = (area > 0 ? covers / area : 0.0) * near + open * own.near + (free - open * own.area) * base;
    made += (1 - own.area) * back_lamps + near_lamps;
    if (at.has_layer != 0u) {
        const vec4 layer = finite_of(texelFetch(over, pixel, 0));
        made = layer + (1 - layer.a) * made;
    }
    if (at.view != 0u) {
        const vec4 before = (area > 0 ? covers / area : 0.0) * near + open * own.near;
        made = viewed(made, radius, reaches, base, before, back_lamps + near_lamps);
    }
    if (pixel == place_of_group) imageStore(result, pixel, made);
}
