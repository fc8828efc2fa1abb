// Separates the light of lamps: the part of a pixel's light that stands out of its surroundings.
layout(std430, binding = 7) readonly buffer Surroundings { vec2 surroundings[]; };  // by tile: realtime_measure.comp

// Interpolates between the four tiles around a pixel, so that no border of tiles shows.
vec2 surroundings_at(ivec2 pixel) {
    const vec2 place = (vec2(pixel) + 0.5) / float(kTile) - 0.5, share = place - floor(place);
    const ivec2 low = clamp(ivec2(floor(place)), ivec2(0), at.tiles - 1), high = clamp(ivec2(floor(place)) + 1, ivec2(0), at.tiles - 1);
    return mix(mix(surroundings[low.y * at.tiles.x + low.x], surroundings[low.y * at.tiles.x + high.x], share.x),
               mix(surroundings[high.y * at.tiles.x + low.x], surroundings[high.y * at.tiles.x + high.x], share.x), share.y);
}

// Means of brightness over 3 x 3, 5 x 5 and 9 x 9 tiles around the group's own. All invocations of the group call it
// together.
const int kWindows = 3;
shared vec4 sums_around[64];  // `split` keeps the radii of its cells here afterwards
shared uint least_around;  // as bits: the smallest squared mean of roots of 3 x 3 tiles
void measure_around() {
    const int own = int(gl_LocalInvocationIndex);
    vec4 sums = vec4(0);
    if (own == 0) least_around = 0x7f7fffffu;
    barrier();
    for (int i = own; i < 81; i += 64) {
        const int row = i / 9;
        const ivec2 d = ivec2(i - 9 * row, row) - 4, tile = clamp(ivec2(gl_WorkGroupID.xy) + d, ivec2(0), at.tiles - 1);
        const vec2 found = surroundings[tile.y * at.tiles.x + tile.x];
        const float light = found.y;
        const int far = max(abs(d.x), abs(d.y));
        if (far <= 1) sums.x += light, atomicMin(least_around, floatBitsToUint(found.x));
        if (far <= 2) sums.y += light;
        sums.z += light;
    }
    sums_around[own] = sums * vec4(1.0 / 9, 1.0 / 25, 1.0 / 81, 0);
    for (int half_way = 32; half_way > 0; half_way >>= 1) {
        barrier();
        if (own < half_way) sums_around[own] += sums_around[own + half_way];
    }
    barrier();
}
// Mean brightness of the light under a disc of this radius; `tile_mean`: that of the nearest tiles.
float mean_over(float radius_px, float tile_mean) {
    const float place = clamp(log2(max(radius_px, 1.0) / 8), 0.0, float(kWindows));
    const float near = place < 1 ? tile_mean : sums_around[0][int(place) - 1];
    return mix(near, sums_around[0][min(int(place), kWindows - 1)], fract(place));
}

// The signed radius of the brightest pixel of a square. A pixel on the rim of a lamp shows lamp and surroundings, and its
// depth may be that of these: a lamp is where it is brightest. `all`: the brightness of the square.
float radius_of_brightest(ivec2 low, int side, out float most, out float all) {
    float radius = 0;
    most = -1;
    all = 0;
    [[dont_unroll]] for (int i = 0; i < side * side; ++i) {
        const ivec2 pixel = clamp(low + ivec2(i % side, i / side), ivec2(0), at.size - 1);
        const float light = brightness(light_of(texelFetch(colours, pixel, 0)));
        all += light;
        if (light > most) most = light, radius = radius_of(texelFetch(depths, pixel, 0).r);
    }
    return radius;
}

// The signed radius of a pixel of a lamp. `combine` draws discs below 2 px as if their light filled a pixel. A lamp fills a
// share of the pixel only: as bright as the pixel is, of the brightest beside it. So the disc is narrower, by second moments.
// Dim pixels are not narrowed, because they receive light through their own discs.
float radius_of_part(float of_lamp, float share) {
    const float less = ramp(0.0, 0.5, share) * (1 - share * share) / 3;
    const float radius = sqrt(max(of_lamp * of_lamp - less, 0.0));
    return of_lamp < 0 ? -radius : radius;
}

// The share of this pixel's light that is a lamp's. A lamp stands out from the surfaces around it. It also has at least a
// sixteenth of the light that all discs of its radius bring to a pixel, so about sixteen lamps at most reach a pixel. Taps show
// all other light. radius: that of the pixel; that of a small lamp replaces it.
float lamp_of(ivec2 pixel, vec4 light, float least, inout float radius) {
    const float kStandsOut = 1.0 / 16, kAtSide = 6;  // twice as bright as white on the host's display
    const float own = brightness(light);
    if (own <= least) return 0;  // most pixels, before any interpolation
    const vec2 around = surroundings_at(pixel);
    float floor_light = 4 * around.x;
    // Light at a side of the picture continues beyond, where taps find it and no lamp is: only very bright light is a lamp there.
    if (min(pixel.x, pixel.y) == 0 || any(equal(pixel, at.size - 1))) floor_light += kAtSide / at.exposure;
    if (own <= floor_light) return 0;
    float most, all;
    const float of_lamp = radius_of_brightest(pixel - 1, 3, most, all), wide = abs(of_lamp), disc = max(3.14159 * wide * wide, 1.0);
    floor_light += max(kStandsOut * disc * own / all, 2.0) * mean_over(wide, around.y);
    const float stands_out = smoothstep(1.0, 2.0, own / floor_light);
    radius = mix(radius, radius_of_part(of_lamp, own / most), stands_out * (1 - blurred_share(max(wide, abs(radius)))));
    return (1 - around.x / own) * stands_out;
}
