// Separates the light of lamps: the part of a pixel's light that stands out of its surroundings.
layout(std430, binding = 7) readonly buffer Surroundings { vec2 surroundings[]; };  // by tile: realtime_measure.comp

// Interpolates between the four tiles around a pixel, so that no border of tiles shows.
vec2 surroundings_at(ivec2 pixel) {
    const vec2 place = (vec2(pixel) + 0.5) / float(kTile) - 0.5, share = place - floor(place);
    const ivec2 low = clamp(ivec2(floor(place)), ivec2(0), at.tiles - 1), high = clamp(ivec2(floor(place)) + 1, ivec2(0), at.tiles - 1);
    return mix(mix(surroundings[low.y * at.tiles.x + low.x], surroundings[low.y * at.tiles.x + high.x], share.x),
               mix(surroundings[high.y * at.tiles.x + low.x], surroundings[high.y * at.tiles.x + high.x], share.x), share.y);
}

// The signed radius of the brightest pixel of a square. A pixel on the rim of a lamp shows lamp and surroundings, and its
// depth may be that of these: a lamp is where it is brightest.
float radius_of_brightest(ivec2 low, int side, out float most) {
    float radius = 0;
    most = -1;
    [[dont_unroll]] for (int i = 0; i < side * side; ++i) {
        const ivec2 pixel = clamp(low + ivec2(i % side, i / side), ivec2(0), at.size - 1);
        const float light = brightness(light_of(texelFetch(colours, pixel, 0)));
        if (light > most) most = light, radius = radius_of(texelFetch(depths, pixel, 0).r);
    }
    return radius;
}

// Light that taps alone show well stays: a few times as bright as its surroundings, more for wider discs. So
// no pixel is reached by many more lamps than are distinguishable.
vec4 lamp_of(ivec2 pixel, vec4 light) {
    const vec2 around = surroundings_at(pixel);
    const float own = brightness(light);
    float floor_light = 4 * around.x + 2 * around.y;
    if (own <= floor_light) return vec4(0);
    float most;
    const float radius = radius_of_brightest(pixel - 1, 3, most);
    floor_light += 0.08 * radius * radius * around.x;
    return own > floor_light ? vec4(light.rgb * (1 - floor_light / own), 0) : vec4(0);
}
