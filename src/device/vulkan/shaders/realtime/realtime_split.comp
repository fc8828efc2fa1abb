// Divides the light of 2 x 2 pixels into near (in front of focus) and everything else, and takes means; a
// group is a tile.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2, rgba16f) writeonly uniform image2DArray cells_1;  // 8 x 8 of a tile
layout(binding = 3, rgba16f) writeonly uniform image2DArray cells_2;  // means over 2 x 2 of them
layout(binding = 4, rgba16f) writeonly uniform image2DArray cells_4;
layout(binding = 5, rgba16f) writeonly uniform image2DArray cells_8;
layout(std430, binding = 6) writeonly buffer Tiles { vec4 tiles[]; };  // realtime_reach.comp
layout(std430, binding = 8) writeonly buffer Lamps { uvec4 lamps[]; };  // by tile: which cells have one, the largest radius
layout(std430, binding = 9) writeonly buffer CellLamps { uvec4 cell_lamps[]; };  // realtime.glsl: lamp_at
#include "realtime.glsl"
#include "realtime_lamps.glsl"

const int kAcross = kTile + 2;
shared float window[kAcross * kAcross];  // signed radii by depth, of the tile's pixels and those around it
shared vec4 part[kLayers][64];
shared uint lamp_cells[2], lamp_px;  // as bits: they are ordered as floats are
float px_at(ivec2 pixel) { return radius_of(texelFetch(depths, clamp(pixel, ivec2(0), at.size - 1), 0).r); }
float near_px_at(ivec2 pixel, int place) { return window[place]; }
#include "realtime_rims.glsl"

// The signed radius of a cell's lamp, which is that of its brightest pixel. One or two bright pixels among dark ones of the
// same depth, beside farther pixels, are a half-covered lamp behind.
float lamp_radius(ivec2 cell) {
    const int kSide = 4;
    const ivec2 low = 2 * cell - 1;
    float most, all, most_behind = -1, behind;
    const float found = radius_of_brightest(low, kSide, most, all);
    if (found > -1.5) return found;
    ivec2 alike = ivec2(0);  // of its depth: as bright, dark
    [[dont_unroll]] for (int i = 0; i < kSide * kSide; ++i) {
        const ivec2 pixel = clamp(low + ivec2(i % kSide, i / kSide), ivec2(0), at.size - 1);
        const float light = brightness(light_of(texelFetch(colours, pixel, 0)));
        const float radius = radius_of(texelFetch(depths, pixel, 0).r);
        if (radius < found + 1.5) ++alike[light > 0.25 * most ? 0 : 1];
        else if (light > most_behind) most_behind = light, behind = radius;
    }
    return most_behind >= 0 && alike.x <= 2 && alike.y >= 5 ? behind : found;
}

// The lamp of a cell: its light; where it is, times its brightness.
void keep_lamp(ivec2 cell, vec4 light, vec2 place) {
    const uint own = gl_LocalInvocationIndex;
    if (own < 2u) lamp_cells[own] = 0u;
    if (own == 2u) lamp_px = 0u;
    barrier();
    const float bright = brightness(light);
    if (bright > 0) {
        const float found = lamp_radius(cell), radius = found < 0 ? min(found, -0.5) : max(found, 0.5);
        cell_lamps[lamp_at(cell)] = packed_lamp(CellLamp(0.25 * light.rgb, 4, place / bright, radius));
        atomicOr(lamp_cells[own / 32u], 1u << (own % 32u));
        atomicMax(lamp_px, floatBitsToUint(abs(radius)));
    }
    barrier();
    if (own == 0u) {
        const ivec2 tile = ivec2(gl_WorkGroupID.xy);
        lamps[tile.y * at.tiles.x + tile.x] = uvec4(lamp_cells[0], lamp_cells[1], lamp_px, 0u);
    }
}

// The share of a near colour in a pixel whose colour lies between the near colour and one behind it; 0 if it does not lie
// between them.
float share_of(vec4 near, vec4 light, vec4 behind) {
    const float kAlike = 0.97;
    const vec3 more = light.rgb - behind.rgb, most = near.rgb - behind.rgb;
    const float share = dot(more, most) / dot(most, most);
    return share > 0.02 && share * length(most) > kAlike * length(more) ? share : 0.0;
}

// Reads the window. All invocations of the group call it together.
void read_window() {
    const ivec2 tile = kTile * ivec2(gl_WorkGroupID.xy), cell = 2 * ivec2(gl_LocalInvocationID.xy), last = at.size - 1;
    const ivec2 first = min(tile + cell, last), second = min(tile + cell + 1, last);
    const int first_place = (cell.y + 1) * kAcross + cell.x + 1;
    window[first_place] = radius_of(texelFetch(depths, first, 0).r);
    window[first_place + 1] = radius_of(texelFetch(depths, ivec2(second.x, first.y), 0).r);
    window[first_place + kAcross] = radius_of(texelFetch(depths, ivec2(first.x, second.y), 0).r);
    window[first_place + kAcross + 1] = radius_of(texelFetch(depths, second, 0).r);
    const int kSide = kAcross - 1;  // each side of the rim without its last pixel
    for (int i = int(gl_LocalInvocationIndex); i < 4 * kSide; i += 64) {
        const int side = i / kSide, along = i - side * kSide, back = side < 2 ? along : kSide - along;
        const ivec2 place = (side & 1) == 0 ? ivec2(back, side < 2 ? 0 : kSide) : ivec2(side < 2 ? kSide : 0, back);
        const ivec2 pixel = clamp(tile + place - 1, ivec2(0), at.size - 1);
        window[place.y * kAcross + place.x] = radius_of(texelFetch(depths, pixel, 0).r);
    }
    barrier();
}

// The smallest radius of 3 x 3 pixels around each of a cell's four. place: that of its first in the window.
vec4 nearest_around(int place) {
    vec2 rows[4];
    for (int y = 0; y < 4; ++y) {
        const int i = place + (y - 1) * kAcross;
        rows[y] = min(vec2(window[i - 1], window[i + 2]), vec2(min(window[i], window[i + 1])));
    }
    const vec2 middle = min(rows[1], rows[2]);
    return vec4(min(rows[0], middle), min(rows[3], middle));
}

const float kApart = 0.4;  // pixels: radii that differ by less are blurred alike

// The signed radius of a pixel of the tile. A silhouette pixel shows a near surface and its background, and
// may have the background's depth. It gets the near surface's radius if that gives most of its light; or if that is hardly
// blurred, because the pixel is then part of a sharp outline. `place`: its own in the window; `radius`: that of its depth.
float own_radius(ivec2 pixel, int place, vec4 light, float radius) {
    const float kOutlinePx = 2;
    const float own = brightness(light);
    vec4 bright = light, dark = light;
    vec2 found = vec2(radius);  // of the brightest nearer pixel around, and of the darkest
    ivec2 to_bright = ivec2(0), to_dark = ivec2(0);
    // Loops, because nine pixels at once need half as many registers again. Offsets are 0, 1 and -1, own row and column first: of
    // pixels alike, these are not copies beyond the border of the picture.
    [[dont_unroll]] for (int y = 0; y < 2; y = 1 - 2 * y) {
        const int row = place + y * kAcross;
        [[dont_unroll]] for (int x = 0; x < 2; x = 1 - 2 * x) {
            const float reaches = window[row + x];
            if (reaches > radius - kApart) continue;
            const ivec2 to = ivec2(x, y);
            const vec4 colour = light_of(texelFetch(colours, clamp(pixel + to, ivec2(0), at.size - 1), 0));
            if (brightness(colour) > brightness(bright)) bright = colour, found.x = reaches, to_bright = to;
            if (brightness(colour) < brightness(dark)) dark = colour, found.y = reaches, to_dark = to;
        }
    }
    const bool is_dark = to_bright == ivec2(0);
    const ivec2 to = is_dark ? to_dark : to_bright;
    if (to == ivec2(0)) return radius;
    const float near_px = is_dark ? found.y : found.x;
    const vec4 near = is_dark ? dark : bright;
    const ivec2 across = clamp(pixel - 2 * to, ivec2(0), at.size - 1);
    if (radius_of(texelFetch(depths, across, 0).r) < near_px + kApart) return radius;
    const vec4 behind = light_of(texelFetch(colours, across, 0));
    const float share = share_of(near, light, behind);
    if (share == 0) return radius;
    if (!is_dark) return brightness(near) >= 1.5 * brightness(behind) && share * brightness(near) > 0.5 * own ? near_px : radius;
    // Before wider discs the background's part of the pixel would stay as a sharp dot.
    const float least_px = -kOutlinePx;
    return share < 1 && near_px > least_px && near_px < kOutlinePx && brightness(behind) < 4 * surroundings_at(pixel).x ? near_px : radius;
}

// Weight of this light in the mean radius over several depths. The square root of brightness keeps the sum of weights
// within the range of half floats.
float counts_of(vec4 light) { return clamp(sqrt(at.exposure * brightness(light)), 1e-3, 60.0); }

// Weights of the four parts of a cell at a side of the picture; count: how many cells there are. Taps beyond the picture read
// these cells, so the outer half of each counts more: it is the half that continues.
vec4 weights_at(ivec2 cell, ivec2 count) {
    const float kOuter = 0.75;
    const vec2 first = 0.5 + (kOuter - 0.5) * (vec2(equal(cell, ivec2(0))) - vec2(equal(cell, count - 1))), second = 1 - first;
    return vec4(first.x, second.x, first.x, second.x) * vec4(first.yy, second.yy);
}
vec4 mean_of(int layer, int upper, int lower, vec4 w) {
    return w.x * part[layer][upper] + w.y * part[layer][upper + 1] + w.z * part[layer][lower] + w.w * part[layer][lower + 1];
}

void main() {
    const uint own = gl_LocalInvocationIndex;
    const ivec2 cell = ivec2(gl_GlobalInvocationID.xy), local = ivec2(gl_LocalInvocationID.xy);
    read_window();
    measure_around();
    vec4 near_light = vec4(0), back_light = vec4(0);
    float near_area = 0, near_radius = 0, near_counts = 0, back_area = 0, back_weight = 0, back_radius = 0, back_counts = 0;
    vec3 range = vec3(0, 0, -at.most_px);  // largest radius in front of focus, of small blurs, and the last of `tiles` with its sign turned
    vec2 lamp_place = vec2(0);
    vec4 lamp = vec4(0), own_radii;
    const int first_place = (2 * local.y + 1) * kAcross + 2 * local.x + 1;
    const vec4 nearest = nearest_around(first_place);
    const ivec2 first_pixel = 2 * cell, last = at.size - 1;
    const float least_lamp = 4 * uintBitsToFloat(least_around), least_shadow_px = -at.most_px * (1.0 / float(kShadowSteps));
    const ivec2 tile = ivec2(gl_WorkGroupID.xy), last_tile = at.tiles - 1;
    const bool is_inner = min(tile.x, tile.y) > 0 && tile.x < last_tile.x && tile.y < last_tile.y;
    const vec4 shares = is_inner ? vec4(0.25) : weights_at(cell, 8 * at.tiles);
    for (int i = 0; i < 4; ++i) {
        // Continues the border beyond the picture.
        const ivec2 corner = ivec2(i & 1, i >> 1), drawn_at = first_pixel + corner, pixel = min(drawn_at, last);
        vec4 light = light_of(texelFetch(colours, pixel, 0));
        const int place = first_place + corner.y * kAcross + corner.x;
        const float of_depth = window[place];
        float radius = of_depth;
        if (nearest[i] <= of_depth - kApart) radius = own_radius(drawn_at, place, light, of_depth);
        uint mark = radius != of_depth ? kSilhouette : 0u;
        const float of_lamp = lamp_of(pixel, light, least_lamp, radius);
        const float drawn = blurred_share(abs(radius));  // by cells
        if (of_lamp > 0) {
            const vec4 bright = of_lamp * vec4(light.rgb, 0);
            light -= bright;
            if (pixel == drawn_at) {
                const vec4 taken = drawn * bright;
                lamp += taken;
                lamp_place += brightness(taken) * (vec2(corner) + 0.5);
            }
        } else if (nearest[i] <= kRimPx && nearest[i] <= of_depth - 1 && mark == 0u) {
            float near_px, taken;
            const vec4 part = near_part(drawn_at, place, light, near_px, taken);
            if (part != vec4(0)) mark = kRimPixel;
            light -= taken * part;
            // The part adds hardly any area, because pixels with the near surface's depth show as much of the background.
            const float near = 0.25 * blurred_share(-near_px), hardly = 1e-3 * near;
            near_light += near * part;
            near_area += hardly, near_counts += hardly;
            near_radius += hardly * gathered_radius(near_px);
        }
        own_radii[i] = with_mark(radius, mark);
        // Light in focus counts as a quarter of a pixel: `combine` may continue it behind near surfaces. In silhouettes in focus
        // it blurs the background.
        const float all_px = abs(radius), fine_px = all_px > kSharpPx ? (all_px < kWholePx ? all_px : 0.0) : (mark != 0u ? 1.0 : 0.25);
        range = max(range, vec3(-radius, fine_px, radius < least_shadow_px ? -at.most_px : -radius));
        if (radius < -2) {
            const float near = 0.25 * drawn;
            near_light += near * light, near_area += near;
            // The brighter light decides the mean radius of a cell with two depths.
            const float near_count = near * counts_of(light);
            near_counts += near_count;
            near_radius += near_count * gathered_radius(radius);
        }
        if (radius > -2.5) {
            // Light in focus hardly counts, or a tap between two cells would gather it.
            float back = shares[i], shown = 1e-3;  // by cells
            if (radius < -2) back *= ramp(-2.5, -2.0, radius);
            if (radius > 2) shown = max(2 * drawn / (1 + drawn), shown);
            const float weight = back * shown;
            back_light += weight * light, back_area += back, back_weight += weight;
            // Emptiness has the radius of the surface beside it, or that surface would be blurred by the radius
            // of emptiness.
            const float counts = weight * clamp(light.a, 1e-3, 1.0);
            back_counts += counts, back_radius += counts * (radius > 0.5 ? gathered_radius(radius) : 0.0);
        }
    }
    keep_lamp(cell, lamp, lamp_place);
    const vec4 back = vec4(back_weight, back_radius, back_area, back_counts), near = vec4(near_area, near_radius, near_counts, 1 - back_area);
    part[kBackLight][own] = back_light;
    part[kBack][own] = back;
    part[kNearLight][own] = near_light;
    part[kNear][own] = near;
    imageStore(cells_1, ivec3(cell, kBackLight), back_light);
    imageStore(cells_1, ivec3(cell, kBack), back);
    imageStore(cells_1, ivec3(cell, kNearLight), near_light);
    imageStore(cells_1, ivec3(cell, kNear), near);
    sums_around[own].xyz = range;
    imageStore(cells_1, ivec3(cell, kRadii), own_radii);
    uint quarters = 0u;  // a bit for each quarter of the tile with small blurs, then one for each with these or light in focus
    for (int side = 4; side > 0; side >>= 1) {
        barrier();
        const bool is_one = max(local.x, local.y) < side;
        vec4 mean[kLayers];
        vec3 both;
        if (is_one) {
            if (side == 1)
                for (int i = 0; i < 4; ++i) quarters |= (sums_around[i].y > kSharpPx ? 1u : 0u) << i | (sums_around[i].y > 0 ? 16u : 0u) << i;
            const int a = 2 * local.y * 2 * side + 2 * local.x, b = a + 2 * side;
            const vec4 w = is_inner ? vec4(0.25) : weights_at(side * tile + local, side * at.tiles);
            mean[kBackLight] = mean_of(kBackLight, a, b, w);
            mean[kBack] = mean_of(kBack, a, b, w);
            mean[kNearLight] = mean_of(kNearLight, a, b, vec4(0.25));
            mean[kNear] = mean_of(kNear, a, b, vec4(0.25));
            both = max(max(sums_around[a].xyz, sums_around[a + 1].xyz), max(sums_around[b].xyz, sums_around[b + 1].xyz));
        }
        barrier();
        if (is_one) {
            const ivec2 place = tile * side + local;
            for (int k = 0; k < kLayers; ++k) {
                part[k][local.y * side + local.x] = mean[k];
                if (side == 4) imageStore(cells_2, ivec3(place, k), mean[k]);
                if (side == 2) imageStore(cells_4, ivec3(place, k), mean[k]);
                if (side == 1) imageStore(cells_8, ivec3(place, k), mean[k]);
            }
            sums_around[local.y * side + local.x].xyz = both;
        }
    }
    if (own == 0u) tiles[tile.y * at.tiles.x + tile.x] = vec4(sums_around[0].x, float(quarters), 0, -sums_around[0].z);
}
