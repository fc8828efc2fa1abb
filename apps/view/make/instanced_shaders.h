// The GLSL programs of instanced_draw.cpp.
#pragma once

namespace petzval::view {

// Declarations that all programs begin with. The atlas holds far sprites on its left half, near ones on its
// right; level 0 is above, all others are side by side below it.
inline constexpr char kInstancedShared[] = R"(#version 150
uniform ivec2 size;
uniform int every, levels, blades, rim_count;
uniform float turn, area;
uniform vec2 rims[4];
uniform sampler2D colours, radii, atlas;
const int kBorder = 12;
const float kWidest = 8.0;
int texels(int pixels, int level) { return (pixels + (1 << level) - 1) >> level; }
ivec2 atlas_size() { return ivec2(2 * (size.x + 2 * kBorder * levels), size.y + texels(size.y, 1) + 4 * kBorder); }
ivec2 corner_of(int level, bool near) {
    ivec2 corner = ivec2(near ? size.x + 2 * kBorder * levels : 0, 0) + kBorder;
    if (level == 0) return corner;
    corner.y += size.y + 2 * kBorder;
    for (int l = 1; l < level; ++l) corner.x += texels(size.x, l) + 2 * kBorder;
    return corner;
}
)";

// Depth decides the size of a pixel's sprite, which way up it is, and its level.
inline constexpr char kInstancedVertex[] = R"(
flat out vec4 light;
out vec2 pupil;
flat out vec2 field;
flat out float texels_per_pupil;
void main() {
    int across = (size.x + every - 1) / every;
    ivec2 first = every * ivec2(gl_InstanceID % across, gl_InstanceID / across);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < every * every; ++i)
        sum += texelFetch(colours, min(first + ivec2(i % every, i / every), size - 1), 0);
    float radius = texelFetch(radii, min(first + every / 2, size - 1), 0).r, wide = abs(radius);
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    light = vec4(0.0); pupil = vec2(0.0); field = vec2(0.0); texels_per_pupil = 1.0;
    if (!(wide >= 0.5)) return;
    int level = clamp(int(ceil(log2(wide / kWidest))), 0, levels - 1);
    float scale = float(1 << level);
    texels_per_pupil = wide / scale;
    vec2 corner = (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0) * (1.0 + 1.0 / texels_per_pupil);
    pupil = radius < 0.0 ? -corner : corner;
    vec2 middle = vec2(first) + 0.5 * float(every);
    vec2 place = vec2(corner_of(level, radius < 0.0)) + (middle + wide * corner) / scale;
    gl_Position = vec4(2.0 * place / vec2(atlas_size()) - 1.0, 0.0, 1.0);
    light = sum / (area * wide * wide);
    field = (middle - 0.5 * vec2(size)) / (0.5 * length(vec2(size)));
}
)";

// Blades and rims of the barrel cut the sprite.
inline constexpr char kInstancedFragment[] = R"(
flat in vec4 light;
in vec2 pupil;
flat in vec2 field;
flat in float texels_per_pupil;
out vec4 made;
void main() {
    float outside = blades < 3 ? length(pupil) - 1.0 : -1.0, slice = 6.2831853 / float(max(blades, 3));
    for (int i = 0; i < blades; ++i) {
        float angle = turn + (float(i) + 0.5) * slice;
        outside = max(outside, dot(pupil, vec2(cos(angle), sin(angle))) - cos(0.5 * slice));
    }
    for (int i = 0; i < rim_count; ++i) outside = max(outside, length(pupil + rims[i].x * field) - rims[i].y);
    made = light * clamp(0.5 - outside * texels_per_pupil, 0.0, 1.0);
}
)";

inline constexpr char kCompositeVertex[] = R"(
void main() { gl_Position = vec4(2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0, 0.0, 1.0); }
)";

// Far levels lie over the sharp picture where a pixel is behind focus, near levels over all.
inline constexpr char kCompositeFragment[] = R"(
out vec4 made;
vec4 all_levels(vec2 pixel, bool near) {
    vec4 sum = vec4(0.0);
    for (int level = 0; level < levels; ++level)
        sum += textureLod(atlas, (vec2(corner_of(level, near)) + pixel / float(1 << level)) / vec2(atlas_size()), 0.0);
    return sum;
}
vec4 hidden(ivec2 pixel, float wide, vec4 near) {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        vec2 way = vec2(cos(0.785398 * float(i)), sin(0.785398 * float(i)));
        ivec2 there = clamp(pixel + ivec2(round((wide + 1.0) * way)), ivec2(0), size - 1);
        if (texelFetch(radii, there, 0).r > -0.5 * wide) sum += vec4(texelFetch(colours, there, 0).rgb, 1.0);
    }
    return sum.a > 0.0 ? sum / sum.a : near / max(near.a, 1e-4);
}
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sharp = texelFetch(colours, pixel, 0), far = all_levels(gl_FragCoord.xy, false),
         near = all_levels(gl_FragCoord.xy, true);
    float radius = texelFetch(radii, pixel, 0).r;
    vec4 blurred = far / max(far.a, 1e-4);
    if (radius < 0.0) blurred = mix(hidden(pixel, -radius, near), blurred, smoothstep(0.1, 0.5, far.a));
    vec4 back = mix(sharp, blurred, smoothstep(0.5, 1.5, abs(radius)));
    made = near / max(near.a, 1.0) + (1.0 - min(near.a, 1.0)) * back;
}
)";

}  // namespace petzval::view
