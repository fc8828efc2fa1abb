#include "glare/filter.h"

#include "base/fft.h"

#include <algorithm>
#include <complex>
#include <vector>

namespace petzval::glare {
namespace {

// The transform of one channel of the kernel around pixel (0, 0).
std::vector<float> spectrum(const kernel::PointSpread& kernel, float Rgba::*channel, const Fft& fft,
                            Workers& workers) {
    const int n = fft.size();
    std::vector<std::complex<float>> field(std::size_t(n) * std::size_t(n));
    for (int y = kernel.extent.y0; y < kernel.extent.y1; ++y)
        for (int x = kernel.extent.x0; x < kernel.extent.x1; ++x)
            field[std::size_t((y + n) % n) * std::size_t(n) + std::size_t((x + n) % n)] =
                kernel.weights(x - kernel.extent.x0, y - kernel.extent.y0).*channel;
    fft_square(field, fft, false, workers);
    std::vector<float> real;
    real.reserve(field.size());
    for (const auto& value : field) real.push_back(value.real());
    return real;
}

}  // namespace

int transform_size(int reach, int width, int height) {
    int n = kLanes;  // at least as much tile as margin, and no larger than the picture needs
    while (n < 3 * reach && n < std::max(width, height) + 2 * reach) n *= 2;
    while (n <= 2 * reach) n *= 2;
    return n;
}

Filter filter_of(const kernel::PointSpread& kernel, int size, Workers& workers) {
    const Fft fft(size);
    return {std::max(-kernel.extent.x0, -kernel.extent.y0), size, spectrum(kernel, &Rgba::r, fft, workers),
            spectrum(kernel, &Rgba::g, fft, workers), spectrum(kernel, &Rgba::b, fft, workers)};
}

}  // namespace petzval::glare
