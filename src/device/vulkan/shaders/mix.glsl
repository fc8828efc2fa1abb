// What the three passes of a draft share: mix.cpp beside this folder writes these words.

// For each blur: level, cells across and down, the first row of cells that is here and how many, its first cell;
// then weights, radius and shares inside along x, and along y. A blur without cells is not used.
const uint kBlurWords = 12u;
const uint kNearLarge = 0u, kNearSmall = 1u, kFarSmall = 2u, kFarLarge = 3u, kBackdrop = 4u;  // where layered
const uint kSmall = 0u, kLarge = 1u;                                                        // else
const uint kLayered = 0u, kByRadius = 1u, kByDepth = 2u;                                    // laws

layout(push_constant) uniform Push {
    uint blur, axis;                 // that a pass is about
    uint width, height, first_row;   // of the picture; the first row of pixels that is here
    uint out_row, out_rows;          // rows of the result
    uint law, view;
    float near[6], far[6];           // RadiusMix
} at;

uint fact(uint blur, uint which) { return words[kBlurWords * blur + which]; }
bool is_used(uint blur) { return fact(blur, 1u) > 0u; }
float number(uint word) { return uintBitsToFloat(words[word]); }

// engine/gaussian/gaussian_mix.cpp: shares of the sharp picture, of the smaller and of the larger blur. Of a law by
// depth the value is the share of the sharp one.
vec3 by_radius(float radius_px, float m[6]) {
    const float within = 0.5, r = max(0.0, radius_px - m[0]) * m[1], small_px = m[2], large_px = m[4];
    if (large_px <= within || r <= within) return vec3(1, 0, 0);
    if (r < small_px) {
        const float small = min(1.0, (r * r - within * within) * m[3]);
        return vec3(1 - small, small, 0);
    }
    const float large = large_px > small_px ? min(1.0, (r * r - small_px * small_px) * m[5]) : 1.0;
    return vec3(0, 1 - large, large);
}
vec3 shares(float value) {
    if (at.law == kByDepth) return vec3(value, value * (1 - value), (1 - value) * (1 - value));
    if (at.law == kByRadius) return by_radius(abs(value), at.far);
    return value < 0 ? by_radius(-value, at.near) : by_radius(value, at.far);
}
