// A rendered frame before the lens's blur.
#pragma once

#include "petzval/camera.h"
#include "petzval/deep.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/light_point.h"
#include "petzval/light_spectrum.h"
#include "petzval/place.h"

#include <optional>
#include <variant>
#include <vector>

namespace petzval {

// Another picture of the same surfaces as the frame's colour, same size, blurred by the same weights.
struct ColourLayer {
    View<const Rgba> colour;  // scene-linear, premultiplied; its alpha is not read
    // True: light that sums to the frame's colour with other layers; after the blur the layers
    // still sum to it. False: a matte or another value of surfaces, blurred like their
    // coverage.
    bool is_light = true;
    // Spectrum of this light, if it differs from LensChoice::light: its share of the frame's colour is then
    // blurred with that lamp too. For light only. Each lamp takes the time of a frame. Not for engine
    // gaussian, whose blur does not depend on wavelength.
    std::optional<LightSpectrum> spectrum = {};
};

struct PlanarDepth {
    View<const float> metres;  // along the axis; +infinity for a miss
};
// The signed radius of every pixel's blur instead of its depth; the camera's focus is not used.
struct SignedRadii {
    View<const float> px;
};

// Borrowed pictures, all of one size. They must outlive every object made from them.
struct Rendered {
    Place place;  // position of the pixels in the display window
    Camera camera = {};
    View<const Rgba> colour;  // scene-linear, premultiplied
    std::variant<PlanarDepth, SignedRadii> depth;
    // Depths of deep samples have the unit of `depth`: metres or radii.
    const DeepPicture* deep = nullptr;    // all samples of a deep input; replaces colour and depth
    const DeepPicture* behind = nullptr;  // hidden layers, see docs/conventions.md
    // A holdout matte of deep samples, not blurred: light that lands in a pixel is dimmed by the matte's
    // samples there in front of the light's depth. For engines scatter and reference.
    const DeepPicture* holdout = nullptr;
    // Limits the effect: 1 is the blurred picture, 0 is `colour`, values between mix the two; it limits all
    // effects of the lens. Empty: everywhere.
    View<const float> mask;
    std::vector<ColourLayer> layers;
    // For sprites only: lights to draw on top, hidden by nearer surfaces. Lights that cannot be drawn (not
    // finite, negative, outside the frame) are left out, counted and reported.
    const std::vector<LightPoint>* lights = nullptr;
};

inline bool has_radii(const Rendered& rendered) {
    return std::holds_alternative<SignedRadii>(rendered.depth);
}
// Keeps the kind: depth stays depth, radii stay radii.
inline void set_depth(Rendered& rendered, View<const float> values) {
    if (auto* radii = std::get_if<SignedRadii>(&rendered.depth))
        radii->px = values;
    else
        rendered.depth = PlanarDepth{values};
}
inline View<const float> depth_or_radii(const Rendered& rendered) {
    if (const auto* radii = std::get_if<SignedRadii>(&rendered.depth)) return radii->px;
    return std::get<PlanarDepth>(rendered.depth).metres;
}

}  // namespace petzval
