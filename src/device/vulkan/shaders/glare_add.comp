// Subtracts the light that glare takes from a pixel and adds the light it throws there; alpha stays. In
// place.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 256) in;

layout(std430, binding = 0) buffer Picture { vec4 picture[]; };
layout(std430, binding = 1) readonly buffer Glow { vec4 glow[]; };      // rows of padded_width pixels
layout(std430, binding = 2) readonly buffer Star { vec4 star[]; };
layout(std430, binding = 3) readonly buffer Ghosts { vec4 ghosts[]; };
layout(std430, binding = 4) readonly buffer Sum { vec4 sum[]; };        // of all light
layout(push_constant) uniform Push {
    uint width, height, padded_width;
    float of_all, of_highlights, threshold;
    float of_bloom_light, bloom_threshold;
    float bloom, star, ghosts, veil;  // amounts; veil: by pixel
} at;
#include "glare.glsl"

void main() {
    const uint i = invocation();
    if (i >= at.width * at.height) return;
    const vec4 c = picture[i];
    const vec3 light = usable(c.rgb);
    vec3 left = vec3(finite(c.r), finite(c.g), finite(c.b)) - at.of_all * light;
    if (at.of_highlights > 0) left -= at.of_highlights * highlight(light, at.threshold);
    if (at.of_bloom_light > 0) left -= at.of_bloom_light * highlight(light, at.bloom_threshold);
    if (at.bloom > 0) left += at.bloom * glow[i / at.width * at.padded_width + i % at.width].rgb;
    if (at.star > 0) left += at.star * star[i].rgb;
    if (at.ghosts > 0) left += at.ghosts * ghosts[i].rgb;
    if (at.veil > 0) left += at.veil * sum[0].rgb;
    picture[i] = vec4(left, c.a);
}
