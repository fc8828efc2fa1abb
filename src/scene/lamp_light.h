// The light of small bright lamps, each integrated on its own, so that neither a lamp smaller than a pixel
// nor a disc that sees its lamp through a thousandth of the lens carries noise.
#pragma once

#include "petzval/image.h"

#include "scene/tracing.h"

#include <cstdint>
#include <vector>

namespace petzval::scene {

// A lamp as the camera sees it; px on the sensor.
struct LampImage {
    Lamp lamp;
    Vec3 centre;  // camera space
    float x = 0, y = 0, lamp_radius_px = 0, coc_radius_px = 0;
    // The disc that its light fills.
    float reach_px() const { return lamp_radius_px + std::abs(coc_radius_px); }
    bool touches(const Rect& area) const;
};

// The lamps whose light falls into these pixels. A pinhole when `lens` has no aperture.
std::vector<LampImage> lamp_images(const World& world, const LensRays& lens, const Rect& area);

// Shares of a pixel's square, averaged over the lens.
struct LampShare {
    float unhindered = 0;  // covered by the lamp if nothing stood in front of it
    float seen = 0;        // covered by the part of it that is seen
};

class LampLight {
public:
    // sharp_samples: of lamps that are nearly sharp, few pixels, but very bright ones.
    LampLight(const World& world, const LensRays& lens, int disc_samples, int sharp_samples = 1024);
    LampShare at(const LampImage& image, int x, int y, std::uint32_t seed) const;

private:
    enum class Solved { Pixel, Lens, Lamp };
    bool aim(Solved solved, const LampImage& image, int x, int y, const Point4& point,
             LensRays::Ray& ray) const;

    const World& world_;
    LensRays lens_;
    SobolPoints disc_points_, sharp_points_;
};

}  // namespace petzval::scene
