// A pixel of the result. RESULT: the format of its image.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2DArray cells;
layout(binding = 2) uniform sampler2D over;  // the host's transparent layer, premultiplied
layout(binding = 3) uniform sampler2DArray gathered;
layout(binding = 4, RESULT) writeonly uniform image2D result;
layout(std430, binding = 8) readonly buffer Reach { vec2 reach[]; };
#include "realtime.glsl"

float radius_at(ivec2 pixel) {
    return texelFetch(cells, ivec3(pixel / 2, kRadii), 0)[(pixel.y & 1) * 2 + (pixel.x & 1)];
}
#include "realtime_sprites.glsl"

// Sums blurs too fine for cells of two pixels: a pixel and those around it, each over a disc of its radius.
// Background is seen through the pixel's own disc.
struct Fine {
    vec4 back, near;
    float area;  // of what is in front of focus
};
Fine fine(ivec2 pixel, vec4 sharp, float radius, float widest_px) {
    Fine sum = Fine(sharp, vec4(0), 0);
    if (widest_px == 0) return sum;
    const int far = int(ceil(widest_px));
    vec4 back = vec4(0), guess = vec4(0);
    float back_area = 0, guess_area = 0;
    for (int y = -far; y <= far; ++y)
        for (int x = -far; x <= far; ++x) {
            const ivec2 there = clamp(pixel + ivec2(x, y), ivec2(0), at.size - 1);
            const float own = radius_at(there), reaches = own < 0 ? -own : min(own, radius), disc = max(reaches, 0.5);
            const float covers = clamp(disc + 0.5 - length(vec2(x, float(y) / at.aspect)), 0.0, 1.0);
            const float area = (1 - blurred_share(disc)) * covers / max(1.0, 3.14159 * (disc * disc + 1.0 / 12));
            if (area == 0 && (own < 0 || radius >= 0)) continue;
            const vec4 light = finite_of(texelFetch(colours, there, 0));
            if (own < 0) sum.near += area * light, sum.area += area;
            else {
                const float likely = 1 / (1 + brightness(light));
                back += area * light, back_area += area;
                guess += likely * light, guess_area += likely;
            }
        }
    // Background behind a near surface is estimated from its surroundings, or continues them.
    if (back_area > 1e-3) sum.back = back / back_area;
    else if (guess_area > 0) sum.back = guess / guess_area;
    else if (sum.area > 0) sum.back = sum.near / sum.area;
    // A disc counted pixel by pixel is its area to 4 %.
    if (sum.area > 1) sum.near /= sum.area, sum.area = 1;
    return sum;
}

// Interpolates between the four cells around it; near focus, cells as blurred as the pixel count first.
vec4 back_at(ivec2 pixel, float radius, out float is_known) {
    const vec2 place = (vec2(pixel) + 0.5) * 0.5 - 0.5;
    const ivec2 low = ivec2(floor(place)), last = 8 * at.tiles - 1;
    const vec2 share = place - vec2(low);
    vec4 sum = vec4(0);
    float weights = 0;
    for (int i = 0; i < 4; ++i) {
        const ivec2 d = ivec2(i & 1, i >> 1), cell = clamp(low + d, ivec2(0), last);
        const vec4 area = texelFetch(gathered, ivec3(cell, kGatheredArea), 0);
        const vec2 near_it = mix(1 - share, share, vec2(d));
        const float own = gathered_radius(radius);
        float alike = radius > 0 ? exp2(-4 * abs(area.y - own) / (1 + 0.5 * radius)) : 1.0;
        // If neither is nearly sharp, both know the light between them.
        alike = mix(alike, 1.0, smoothstep(1.0, 2.5, min(own, area.y)));
        const float w = near_it.x * near_it.y * area.z * max(alike, 1e-4);
        sum += w * texelFetch(gathered, ivec3(cell, kGatheredBack), 0);
        weights += w;
    }
    is_known = weights > 1e-6 ? 1.0 : 0.0;
    return weights > 1e-6 ? sum / weights : vec4(0);
}

void main() {
    // A group whole or not at all: its invocations look for lamps together.
    const ivec2 place_of_group = ivec2(gl_GlobalInvocationID.xy), pixel = min(place_of_group, at.size - 1);
    const vec2 place = (vec2(pixel) + 0.5) * 0.5 / vec2(8 * at.tiles);
    const ivec2 tile = pixel / kTile;
    const float radius = radius_at(pixel);
    const vec2 reaches = reach[tile.y * at.tiles.x + tile.x];
    const Fine own = fine(pixel, finite_of(texelFetch(colours, pixel, 0)), radius, reaches.y);
    vec4 near_lamps = vec4(0), back_lamps = vec4(0);
    add_all_lamps(pixel, reaches.x, near_lamps, back_lamps);
    const vec4 near = textureLod(gathered, vec3(place, kGatheredNear), 0);
    float area = textureLod(gathered, vec3(place, kGatheredArea), 0).x, is_known;
    const vec4 back = back_at(pixel, radius, is_known);
    const float hidden = blurred_share(-radius);
    // A completely near pixel has no sharp part; some of its background may be known.
    vec4 base = mix(own.back, back, is_known * blurred_share(abs(radius)));
    base = own.near + (1 - own.area) * base;
    vec4 made = base;
    if (area > 0) {
        const bool fills = is_known == 0 && hidden > 0.99;
        const float covers = fills ? 1.0 : min(area, 1.0);
        made = near * (covers / area) + (1 - covers) * base;
    }
    made += (1 - own.area) * back_lamps + near_lamps;
    if (at.has_layer != 0u) {
        const vec4 layer = finite_of(texelFetch(over, pixel, 0));
        made = layer + (1 - layer.a) * made;
    }
    if (pixel == place_of_group) imageStore(result, pixel, made);
}
