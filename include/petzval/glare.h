// Effects of a lens besides blur: bloom, stars, ghosts, veil, and the loss of light towards the corners. They
// are applied after defocus, in scene-linear light.
//
// Glare moves light and never adds any. The amount of each effect is the fraction of light that it takes from
// a pixel, and its spread sums to 1 per channel. So the sum over the picture is kept, except for light that
// lands outside the frame. Formulas: docs/explain/glare.md.
#pragma once

#include "petzval/camera.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/lens.h"
#include "petzval/place.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <optional>

namespace petzval {

enum class StarQuality {
    Draft,  // streaks in a few passes (M. Kawase, GDC 2003)
    Final,  // diffraction at the aperture's true outline, by wavelength
};

enum class LensCoating {
    None,         // bare glass, about 4 % a surface
    SingleLayer,  // a quarter wave of magnesium fluoride at 550 nm, about 1.5 %, purple
};

// If all amounts are 0, the picture is unchanged bit for bit. Their sum may not exceed 1.
struct GlareAmounts {
    // Gaussian layers, each twice as wide as the one before and all of equal light, so that the glow falls
    // about as 1/r^2; of the whole picture, or only of the light above bloom_threshold.
    double bloom = 0;
    double bloom_radius = 0.08;  // standard deviation of the widest layer, share of the picture's height
    // Bloom spreads light above this, like `threshold` below; >= 0. 0: all light, as in a real lens.
    double bloom_threshold = 0;

    // Spikes across the aperture's edges, of the light above `threshold`: n for an even number of blades n,
    // 2n for an odd one. Needs lens.aperture.blades.
    double star = 0;
    double star_radius = 0.5;  // end of a star's red light, as a fraction of the picture's height
    StarQuality star_quality = StarQuality::Final;

    // Reflections between surfaces, of the light above `threshold`. lens.name is a prescription: paraxial
    // ghosts of every pair of its surfaces with the aperture's true shape; else seven coloured, turned or
    // upright copies of the lights on the line through the centre (M. Kawase, GDC 2003).
    double ghosts = 0;
    LensCoating coating = LensCoating::SingleLayer;

    double veil = 0;  // spread evenly over the picture

    // A pixel's light above this counts as a highlight, for stars and ghosts: share 1 - threshold / largest
    // channel. 1 is diffuse white, so matt surfaces in the scene's own light have no stars; >= 0.
    double threshold = 1;

    bool operator==(const GlareAmounts&) const = default;
};

// Glare amounts with the properties of the shot that they depend on.
struct GlareSettings : GlareAmounts {
    // 550 nm times the f-number, in pixels: the grain of the diffraction pattern. If 0 or below the finest
    // grain that is computed (about star_radius / 500 of the height), that one is used, and it is
    // invisible.
    double diffraction_px = 0;
    Camera camera;                    // for the ghosts of a prescription: all four numbers
    LensChoice lens;                  // the aperture, and the prescription for ghosts
    std::optional<Lens> opened_lens;  // where given, it is taken instead of `lens`, and nothing is read
    // Position of the picture; an empty display window means that the picture is the frame. Fractions of
    // height refer to the display window; ghosts mirror about its centre.
    Place place;
    int threads = 0;             // 0: all this process may use; the result never depends on it
    Workers* workers = nullptr;  // those of a host, in place of `threads`; null: our own
};

// Alpha is kept, because glare adds light and covers nothing. Negative and non-finite colour makes
// no glare; non-finite colour is 0 in the result. Errors: InvalidArgument naming the number that is
// out of range, a star without blades, an unknown lens; ghosts of a prescription without camera
// numbers.
PETZVAL_API Result<Picture> add_glare(View<const Rgba> picture, const GlareSettings& settings);

// Falloff: the light at each place relative to the middle. It is cos^4 of the field angle times the open
// share of the pupil there (by the barrel's cat's eye, or by rays past the rims of a prescription).
struct FalloffSettings {
    Camera camera = {};  // focal length and sensor width; for a prescription also f-number and focus
    LensChoice lens = {};
    std::optional<Lens> opened_lens = {};  // as above
    Place place = {};                      // as above
    int threads = 0;
    Workers* workers = nullptr;
};

// The only function of this header that loses light. It changes colour; alpha is kept. Errors:
// InvalidArgument for missing camera numbers, an unknown lens.
PETZVAL_API Result<Picture> add_falloff(View<const Rgba> picture, const FalloffSettings& settings);

}  // namespace petzval
