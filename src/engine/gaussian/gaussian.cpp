// The draft engine: the sharp picture mixed with a smaller and a larger Gaussian blur
// (docs/published.md). Always round, whatever the lens: it has the disc's second moment, not its
// shape.
#include "engine/gaussian/gaussian.h"

#include "device/device.h"
#include "engine/gaussian/plan.h"
#include "engine/waist/memory.h"

#include <algorithm>
#include <chrono>

namespace petzval::engine {
namespace {

// The result, and the layers with the copies that blurring makes of one, on the finest grid that any needs.
std::size_t bytes_per_pixel(const Input& input) {
    float smallest_px = std::max(-input.nearest_coc_px, input.farthest_coc_px);
    for (const float side : {-input.nearest_coc_px, input.farthest_coc_px})
        if (side > kWithinPixelPx) smallest_px = std::min(smallest_px, side);
    const int level = blur_level(double(std::max(smallest_px / 2, kWithinPixelPx)), input.pixel_aspect);
    return sizeof(Rgba) + ((8 * (sizeof(Rgba) + sizeof(float))) >> (2 * level));
}

}  // namespace

std::size_t least_gaussian_bytes(const Input& input) {
    return whole_picture_bytes(input, bytes_per_pixel(input));
}

Result<Output> run_gaussian(const Input& input) {
    const auto start = std::chrono::steady_clock::now();
    const GaussianView view = input.gaussian.view;
    const float largest_px = std::max(-input.nearest_coc_px, input.farthest_coc_px);
    if (const Status fits = fits_memory(input, bytes_per_pixel(input), "gaussian"); !fits)
        return fits.error();
    Output output;
    output.image = Picture::uninitialised(input.width(), input.height());
    if (view == GaussianView::Sharp || (largest_px <= kWithinPixelPx && view == GaussianView::Result)) {
        for (int y = 0; y < input.height(); ++y)
            std::copy_n(input.colour.row(y), input.width(), output.image.row(y));
        return output;
    }
    input.device->mix(plan_gaussian(input), output.image, {*input.workers, *input.progress});
    if (!input.progress->advance(1)) return Error{ErrorCode::Cancelled, "cancelled"};
    output.stages = {
        {"gaussian", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()}};
    return output;
}

}  // namespace petzval::engine
