// A pixel from the sharp picture and the blurs, by the plan's law. Formulas are device/cpu/mix.cpp's.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "laws/compositing.h"
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 2) readonly buffer Values { float values[]; };
layout(std430, binding = 3) readonly buffer ExtraOf { uint extra_of[]; };
layout(std430, binding = 4) readonly buffer Extras { vec4 extras[]; };
layout(std430, binding = 5) readonly buffer Light { vec4 light_of[]; };
layout(std430, binding = 6) readonly buffer Covered { float covered_of[]; };
layout(std430, binding = 7) writeonly buffer Result { vec4 result[]; };
#include "mix.glsl"
#include "mix_extras.glsl"

const uint kViewSmall = 1u, kViewLarge = 2u, kViewIndex = 3u;

// A blur at a pixel, of the cells around it.
void read(uint blur, uvec2 pixel, out vec4 light, out float covered) {
    const int level = int(fact(blur, 0u));
    const ivec2 last = ivec2(fact(blur, 1u), fact(blur, 2u)) - 1, own = ivec2(pixel) >> level;
    const int first = int(fact(blur, 5u)) - int(fact(blur, 3u)) * (last.x + 1);
    if (level == 0) {
        const int k = first + own.y * (last.x + 1) + own.x;
        light = light_of[k], covered = covered_of[k];
        return;
    }
    const vec3 across = spline_shares(int(pixel.x), level), down = spline_shares(int(pixel.y), level);
    const int left = max(0, own.x - 1), right = min(last.x, own.x + 1);
    light = vec4(0), covered = 0;
    for (int y = -1; y <= 1; ++y) {
        const int row = first + clamp(own.y + y, 0, last.y) * (last.x + 1);
        const vec3 share = down[y + 1] * across;
        light += share.x * light_of[row + left] + share.y * light_of[row + own.x] + share.z * light_of[row + right];
        covered += dot(share, vec3(covered_of[row + left], covered_of[row + own.x], covered_of[row + right]));
    }
}

// Each layer takes of the pixel's lens what it arrives with, or what is left.
void take(vec4 light, float covered, inout vec4 sum, inout float free) {
    if (covered <= kLeastBlurred) return;
    const float taken = min(covered, free);
    sum += taken / covered * light;
    free -= taken;
}
void take_blur(uint blur, uvec2 pixel, inout vec4 sum, inout float free) {
    vec4 light;
    float covered;
    read(blur, pixel, light, covered);
    take(light, covered, sum, free);
}

void take_sharp(uint number, inout vec4 sum, inout float free) {
    const Extra more = extra(number);
    const float sharp = sharp_share(more.mixed);
    take(sharp * more.light, sharp * more.covered, sum, free);
}

vec4 layered(uvec2 pixel, uint k, vec4 colour, float coc_px) {
    vec4 sum = vec4(0);
    float free = 1;
    for (uint blur = 0u; blur < near_count(); ++blur) take_blur(blur, pixel, sum, free);
    const uint more = extras_at(k);
    if ((more & kRim) != 0u) take_sharp(rim_of(more), sum, free);
    const float sharp = sharp_share(own_mix(coc_px));
    take(sharp * colour, sharp, sum, free);
    if ((more & kHidden) != 0u) take_sharp(hidden_of(more), sum, free);
    for (uint blur = near_count(); blur < layer_count(); ++blur) take_blur(blur, pixel, sum, free);
    return free < 1 - kLeastBlurred ? sum / (1 - free) : colour;
}

vec4 blurred(uint blur, uvec2 pixel) {
    vec4 light;
    float unused;
    read(blur, pixel, light, unused);
    return light;
}

// A blur of the whole picture, if the law goes by radius; 0: the sharp one.
vec4 of_stack(int blur, uvec2 pixel, vec4 colour) { return blur == 0 ? colour : blurred(uint(blur - 1), pixel); }

float focus_index(float value) {
    if (at.law == kByDepth) return value;
    const float r = blurred_px(abs(value), at.far), largest = at.far[2];
    return at.far[3] == 0 || r <= kWithin ? 1 : clamp((largest - r) / (largest - kWithin), 0.0, 1.0);
}

// The value of a depth law is the share of the sharp picture.
vec4 mixed(uvec2 pixel, vec4 colour, float value) {
    if (at.view == kViewIndex) return vec4(vec3(focus_index(value)), 1);
    if (at.view == kViewSmall) return blurred(kSmall, pixel);
    if (at.view == kViewLarge) return blurred(kLarge, pixel);
    if (at.law == kByDepth) {
        const float rest = 1 - value;
        if (rest == 0) return colour;
        return value * colour + value * rest * blurred(kSmall, pixel) + rest * rest * blurred(kLarge, pixel);
    }
    const Mix own = in_stack(abs(value), at.far);
    const vec4 lower = of_stack(own.lower, pixel, colour);
    if (own.upper_share == 0) return lower;
    return mix(lower, of_stack(own.lower + 1, pixel, colour), own.upper_share);
}

void main() {
    const uint i = (gl_WorkGroupID.y * 65535u + gl_WorkGroupID.x) * 256u + gl_LocalInvocationIndex;
    if (i >= at.width * at.out_rows) return;
    const uvec2 pixel = uvec2(i % at.width, at.out_row + i / at.width);
    const uint k = (pixel.y - at.first_row) * at.width + pixel.x;
    result[i] = at.law == kLayered ? layered(pixel, k, colours[k], values[k]) : mixed(pixel, colours[k], values[k]);
}
