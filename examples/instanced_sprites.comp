// The layered composite: what is sharp, the levels of the far half over it where a pixel is behind focus, those of the
// near half on top.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "instanced_sprites.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D colours;
layout(binding = 1) uniform sampler2D radii;
layout(binding = 2) uniform sampler2D atlas;
layout(binding = 3, rgba32f) writeonly uniform image2D result;

vec4 all_levels(vec2 pixel, bool near) {
    vec4 sum = vec4(0);
    for (int level = 0; level < at.levels; ++level)
        sum += textureLod(atlas, (vec2(corner_of(level, near)) + pixel / float(1 << level)) / vec2(textureSize(atlas, 0)), 0);
    return sum;
}

// The estimated light behind a near pixel: the mean of farther pixels just outside of the near pixel's own disc.
vec4 hidden(ivec2 pixel, float wide, vec4 near) {
    vec4 sum = vec4(0);
    for (int i = 0; i < 8; ++i) {
        const vec2 way = vec2(cos(0.785398 * float(i)), sin(0.785398 * float(i)));
        const ivec2 there = clamp(pixel + ivec2(round((wide + 1) * way)), ivec2(0), at.size - 1);
        if (texelFetch(radii, there, 0).r > -0.5 * wide) sum += vec4(texelFetch(colours, there, 0).rgb, 1);
    }
    return sum.a > 0 ? sum / sum.a : near / max(near.a, 1e-4);
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, at.size))) return;
    const vec4 sharp = texelFetch(colours, pixel, 0), far = all_levels(vec2(pixel) + 0.5, false),
               near = all_levels(vec2(pixel) + 0.5, true);
    const float radius = texelFetch(radii, pixel, 0).r;
    vec4 blurred = far / max(far.a, 1e-4);
    if (radius < 0) blurred = mix(hidden(pixel, -radius, near), blurred, smoothstep(0.1, 0.5, far.a));
    const vec4 back = mix(sharp, blurred, smoothstep(0.5, 1.5, abs(radius)));
    imageStore(result, pixel, near / max(near.a, 1.0) + (1 - min(near.a, 1.0)) * back);
}
