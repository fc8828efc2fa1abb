// A pixel of the result. RESULT: the format of its image.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2) uniform sampler2D over;  // the host's transparent layer, premultiplied
layout(binding = 3) uniform sampler2DArray gathered;
layout(binding = 4, RESULT) writeonly uniform image2D result;
#include "realtime.glsl"
#include "realtime_lamps.glsl"
#include "realtime_sprites.glsl"

// Between the four cells around it, those that are as blurred as the pixel before others.
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
        const float alike = radius > 0 ? exp2(-4 * abs(area.y - radius) / (1 + 0.5 * radius)) : 1.0;
        const float w = near_it.x * near_it.y * area.z * max(alike, 1e-4);
        sum += w * texelFetch(gathered, ivec3(cell, kGatheredBack), 0);
        weights += w;
    }
    is_known = weights > 1e-6 ? 1.0 : 0.0;
    return weights > 1e-6 ? sum / weights : vec4(0);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, at.size))) return;
    const vec2 place = (vec2(pixel) + 0.5) * 0.5 / vec2(8 * at.tiles);
    const vec4 sharp = texelFetch(colours, pixel, 0);
    const float radius = radius_of(texelFetch(depths, pixel, 0).r);
    const vec4 lamp = lamp_of(pixel, light_of(sharp));
    vec4 near_lamps = vec4(0), back_lamps = vec4(0);
    add_all_lamps(pixel, near_lamps, back_lamps);
    const vec4 near = textureLod(gathered, vec3(place, kGatheredNear), 0);
    float area = textureLod(gathered, vec3(place, kGatheredArea), 0).x, is_known;
    const vec4 back = back_at(pixel, radius, is_known);
    const float hidden = blurred_share(-radius);
    // A pixel that is wholly near has nothing sharp; of what it hides something may be known.
    const float blurred = max(blurred_share(radius), hidden), share = is_known > 0 ? blurred : 0.0;
    vec4 base = mix(blurred > 0 ? sharp - lamp : sharp, back, share);
    base += (blurred > 0 ? (1 - blurred) * lamp : vec4(0)) + back_lamps;
    vec4 made = base;
    if (area > 0) {
        const bool fills = is_known == 0 && hidden > 0.99;
        const float covers = fills ? 1.0 : min(area, 1.0);
        made = near * (covers / area) + (1 - covers) * base;
    }
    made += near_lamps;
    if (at.has_layer != 0u) {
        const vec4 layer = texelFetch(over, pixel, 0);
        made = layer + (1 - layer.a) * made;
    }
    imageStore(result, pixel, made);
}
