// The neutral tone curve: how scene-linear light is fitted between black and display white.
//
// Curve, per pixel, on its largest channel n (so that no channel ever clips):
//     t(n) = n^p / (n^p + c),   p = 1/(1 - g),   c = g^p (1 - g)/g,   g = 0.18
// the log-logistic response known from vision (Naka and Rushton, J. Physiol. 185, 1966), with its two
// constants set so that mid-grey keeps its value, t(g) = g, and its contrast, t'(g) = 1. It has no joints:
// smooth and rising everywhere, 0 at 0, 1 at infinity, a gentle toe (log slope 1.22) below.
//
// Colour: the pixel is scaled by t(n)/n, which keeps the ratios of its channels, and then moved towards the
// grey of the same largest channel by the share  d(n) = n^2 / (n^2 + 16^2).  Both steps keep
// (max - mid)/(max - min), that is the hue, exactly; only very bright light pales: 6 % at n = 4, half at 16.
// The choice of this desaturation is ours.
#pragma once

#include "petzval/image.h"

namespace petzval::colour {

// t(n) above. n >= 0; returns 0…1.
double tone_curve(double scene_linear);

// Scene-linear colour to display-linear, each channel 0…1. Negative channels count as 0; alpha is kept.
Rgba tone_map(Rgba scene_linear);

// n / (1 + n) on the largest channel n, ratios kept (E. Reinhard et al., Photographic Tone Reproduction for
// Digital Images, 2002, eq. 3; there on luminance, which lets channels clip).
Rgba reinhard(Rgba scene_linear);

// g (n/g)^contrast on the largest channel n, g = 0.18, ratios kept. Requires: contrast > 0.
Rgba with_contrast(Rgba scene_linear, double contrast);

}  // namespace petzval::colour
