// Pictures that show where the blur is: the focus overlay and the circle of confusion as a map.
#pragma once

#include "petzval/image.h"

#include <string>

namespace petzval::cli {

// Display-linear 0…1 pictures, the same size as `coc_radius_px` (signed, + is far; NaN: nothing there,
// black).
//
// Both use blue for near and orange for far, the pair that people with any common colour blindness tell apart
// (after Okabe and Ito, "Color universal design", 2008), and carry a legend unless the picture is too small.
// The overlay shows the picture dimmed and tinted, in focus white; `display` is that picture, display-linear.
// The map is black where the radius is 0 and full colour at the largest radius.
// Radii below permissible_radius_px count as in focus.
Picture focus_overlay(View<const Rgba> display, View<const float> coc_radius_px, float permissible_radius_px,
                      const std::string& title);
Picture coc_map(View<const float> coc_radius_px, const std::string& title);

}  // namespace petzval::cli
