// Parts the light of 2 x 2 pixels into what lies in front of focus and all else, and takes means; a group is a tile.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D depths;
layout(binding = 2, rgba16f) writeonly uniform image2DArray cells_1;  // 8 x 8 of a tile
layout(binding = 3, rgba16f) writeonly uniform image2DArray cells_2;  // means over 2 x 2 of them
layout(binding = 4, rgba16f) writeonly uniform image2DArray cells_4;
layout(binding = 5, rgba16f) writeonly uniform image2DArray cells_8;
layout(std430, binding = 6) writeonly buffer Tiles { vec2 tiles[]; };  // smallest and largest signed radius
#include "realtime.glsl"

shared vec4 part[kLayers][64];
shared vec2 radii[64];

void main() {
    const uint own = gl_LocalInvocationIndex;
    const ivec2 cell = ivec2(gl_GlobalInvocationID.xy), local = ivec2(gl_LocalInvocationID.xy);
    vec4 near_light = vec4(0), back_light = vec4(0);
    float near_area = 0, near_radius = 0, back_area = 0, back_weight = 0, back_radius = 0;
    vec2 range = vec2(1e9, -1e9);
    for (int i = 0; i < 4; ++i) {
        // Beyond the picture its border goes on.
        const ivec2 pixel = min(2 * cell + ivec2(i & 1, i >> 1), at.size - 1);
        const vec4 light = clamp(texelFetch(colours, pixel, 0), vec4(0), vec4(kMostLight));
        const float radius = radius_of(texelFetch(depths, pixel, 0).r);
        range = vec2(min(range.x, radius), max(range.y, radius));
        const float near = 0.25 * blurred_share(-radius), back = 0.25 - near;
        near_light += near * light, near_area += near, near_radius -= near * radius;
        // In a cell with something blurred in it, that is what the cell stands for.
        const float weight = back * mix(0.05, 1.0, blurred_share(radius));
        back_light += weight * light, back_area += back, back_weight += weight;
        back_radius += weight * max(radius, 0.0);
    }
    const float per_weight = back_weight > 0 ? back_area / back_weight : 0.0;
    part[kBackLight][own] = per_weight * back_light;
    part[kBack][own] = vec4(back_area, per_weight * back_radius, 0, 0);
    part[kNearLight][own] = near_light;
    part[kNear][own] = vec4(near_area, near_radius, 0, 0);
    radii[own] = range;
    for (int k = 0; k < kLayers; ++k) imageStore(cells_1, ivec3(cell, k), part[k][own]);
    const ivec2 tile = ivec2(gl_WorkGroupID.xy);
    for (int side = 4; side > 0; side /= 2) {
        barrier();
        const bool is_one = local.x < side && local.y < side;
        vec4 mean[kLayers];
        vec2 both = vec2(0);
        if (is_one) {
            const int a = 2 * local.y * 2 * side + 2 * local.x, b = a + 2 * side;
            for (int k = 0; k < kLayers; ++k)
                mean[k] = 0.25 * (part[k][a] + part[k][a + 1] + part[k][b] + part[k][b + 1]);
            both.x = min(min(radii[a].x, radii[a + 1].x), min(radii[b].x, radii[b + 1].x));
            both.y = max(max(radii[a].y, radii[a + 1].y), max(radii[b].y, radii[b + 1].y));
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
            radii[local.y * side + local.x] = both;
        }
    }
    if (own == 0u) tiles[tile.y * at.tiles.x + tile.x] = radii[0];
}
