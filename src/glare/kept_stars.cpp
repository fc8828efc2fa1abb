#include "glare/kept_stars.h"

#include "glare/star_kernel.h"

#include <algorithm>
#include <cmath>

namespace petzval::glare {

std::shared_ptr<const Filter> KeptStars::star(const ApertureShape& aperture, double radius_px,
                                              double diffraction_px, double pixel_aspect, int width,
                                              int height, Workers& workers) {
    const int reach = int(std::ceil(radius_px * std::max(1.0, pixel_aspect)));
    const StarShape shape{aperture, radius_px, reddest_px(radius_px, diffraction_px), pixel_aspect,
                          transform_size(reach, width, height)};
    {
        const std::lock_guard lock(mutex_);
        const auto known =
            std::find_if(stars_.begin(), stars_.end(), [&](const auto& s) { return s.first == shape; });
        if (known != stars_.end()) {
            stars_.splice(stars_.begin(), stars_, known);
            return known->second;
        }
    }
    // Without the lock: frames that are made side by side may both make it, and neither waits.
    const kernel::PointSpread kernel =
        star_kernel(aperture, radius_px, diffraction_px, pixel_aspect, workers);
    auto made = std::make_shared<const Filter>(filter_of(kernel, shape.transform_size, workers));
    const std::lock_guard lock(mutex_);
    std::erase_if(stars_, [&](const auto& s) { return s.first == shape; });
    stars_.emplace_front(shape, made);
    return made;
}

std::size_t KeptStars::bytes() const {
    const std::lock_guard lock(mutex_);
    std::size_t sum = 0;
    for (const auto& [shape, star] : stars_) sum += star->bytes();
    return sum;
}

void KeptStars::trim(std::size_t max_bytes) {
    const std::lock_guard lock(mutex_);
    std::size_t sum = 0;
    std::erase_if(stars_, [&](const auto& s) { return (sum += s.second->bytes()) > max_bytes; });
}

}  // namespace petzval::glare
