// Which light is that of a lamp: as much of a pixel's as stands out of its surroundings.
layout(std430, binding = 7) readonly buffer Surroundings { vec2 surroundings[]; };  // by tile: realtime_measure.comp

// Between the four tiles around a pixel, so that no border of tiles shows.
vec2 surroundings_at(ivec2 pixel) {
    const vec2 place = (vec2(pixel) + 0.5) / float(kTile) - 0.5, share = place - floor(place);
    const ivec2 low = clamp(ivec2(floor(place)), ivec2(0), at.tiles - 1), high = clamp(ivec2(floor(place)) + 1, ivec2(0), at.tiles - 1);
    return mix(mix(surroundings[low.y * at.tiles.x + low.x], surroundings[low.y * at.tiles.x + high.x], share.x),
               mix(surroundings[high.y * at.tiles.x + low.x], surroundings[high.y * at.tiles.x + high.x], share.x), share.y);
}

// What taps alone show well stays: light a few times as bright as what is around it, the more the wider its disc. So no
// pixel is reached by many more lamps than can be told apart.
vec4 lamp_of(ivec2 pixel, vec4 light, float radius_px) {
    const vec2 around = surroundings_at(pixel);
    const float floor_light = (4 + 0.08 * radius_px * radius_px) * around.x + 2 * around.y, own = brightness(light);
    return own > floor_light ? vec4(light.rgb * (1 - floor_light / own), 0) : vec4(0);
}
