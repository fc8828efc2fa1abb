// Textures in the pupil that dim it: an aperture image, dust, scratches, turning marks.
#pragma once

#include "petzval/image.h"
#include "petzval/lens_choice.h"

#include "kernel/model/coverage.h"

#include <memory>
#include <vector>

namespace petzval::kernel {

// A picture over the square around the unit disc, pixel orientation, upright as the far disc shows it, with
// means over boxes of any size at the same cost (summed areas).
class PupilImage {
public:
    // Values that are negative or not finite count as 0.
    explicit PupilImage(View<const float> values);
    // Over the box of half_width and half_height around a point; outside the square there is nothing.
    double mean(Point middle, double half_width, double half_height) const;
    // Over the part of the box that lies inside the square; 1 where none does.
    double mean_inside(Point middle, double half_width, double half_height) const;

private:
    double sum_up_to(double x, double y) const;

    int width_, height_;
    std::vector<double> sums_;  // of all pixels left of and above a corner
};

// True if the texture changes anything.
bool has_texture(const PupilTexture& texture);

// Everything a texture asks for, multiplied: 0…1. Dust is dark soft specks, more of them small; scratches are
// thin dark curves; onion rings are uneven concentric waves. The same for the same seed.
Plane drawn_texture(const PupilTexture& texture);

// The same with summed areas. A texture is 5 MB and slow to draw: the levels of a lens share the one drawn
// last.
std::shared_ptr<const PupilImage> shared_texture(const PupilTexture& texture);

}  // namespace petzval::kernel
