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
    return stars_.get(shape, [&] {
        const kernel::PointSpread kernel =
            star_kernel(aperture, radius_px, diffraction_px, pixel_aspect, workers);
        return filter_of(kernel, shape.transform_size, workers);
    });
}

}  // namespace petzval::glare
