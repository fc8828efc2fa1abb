#include "kernel/ray_set.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {

BandPicker::BandPicker(const std::vector<colour::SpectralBand>& bands) : bands_(bands) {
    double sum = 0;
    for (const colour::SpectralBand& b : bands_)
        up_to_.push_back(sum += std::abs(b.r) + std::abs(b.g) + std::abs(b.b));
}

BandPicker::Pick BandPicker::pick(double third) const {
    const auto found = std::upper_bound(up_to_.begin(), up_to_.end() - 1, third * up_to_.back());
    const std::size_t i = std::size_t(found - up_to_.begin());
    const colour::SpectralBand& b = bands_[i];
    const double scale = up_to_.back() / (std::abs(b.r) + std::abs(b.g) + std::abs(b.b));
    return {i, {float(b.r * scale), float(b.g * scale), float(b.b * scale), float(b.luminance * scale)}};
}

void balance(std::vector<PupilRay>& rays) {
    double r = 0, g = 0, b = 0, a = 0;
    for (const PupilRay& ray : rays)
        r += double(ray.weight.r), g += double(ray.weight.g), b += double(ray.weight.b),
            a += double(ray.weight.a);
    const double least = 0.5 * double(rays.size());
    const float even = 1 / float(rays.size());
    for (PupilRay& ray : rays) {
        Rgba& w = ray.weight;
        if (r < least || g < least || b < least)
            w = {even, even, even, even};
        else
            w = {float(double(w.r) / r), float(double(w.g) / g), float(double(w.b) / b),
                 float(double(w.a) / a)};
    }
}

}  // namespace petzval::kernel
