// Rays that carry wavelengths: which band a ray stands for, and weights that sum to white.
#pragma once

#include "colour/spectrum.h"
#include "kernel/lens_model.h"

#include <vector>

namespace petzval::kernel {

// Picks bands as often as they matter, |r| + |g| + |b|, so that no ray weighs much more than another.
class BandPicker {
public:
    explicit BandPicker(const std::vector<colour::SpectralBand>& bands);
    struct Pick {
        std::size_t band = 0;
        Rgba weight;  // a is the luminance
    };
    // third: 0 <= third < 1.
    Pick pick(double third) const;

private:
    std::vector<colour::SpectralBand> bands_;
    std::vector<double> up_to_;  // sum of importance up to and including a band
};

// Scales the weights of a set to sum to 1 per channel; a set too small for its colours becomes neutral.
void balance(std::vector<PupilRay>& rays);

}  // namespace petzval::kernel
