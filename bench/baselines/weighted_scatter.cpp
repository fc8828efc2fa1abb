// Plain scatter: every pixel becomes a disc of its radius whose light is spread evenly, and the sum of light
// is divided by the sum of weights (Potmesil, Chakravarty, "A Lens and Aperture Camera Model for Synthetic
// Image Generation", SIGGRAPH 1981). Nothing hides anything. Threads own bands of rows.
#include "baselines/baseline.h"

#include <numbers>

namespace petzval::baselines {
namespace {

void add_disc(const Input& input, int x, int y, const Rect& band, Picture& sums, Plane& weights) {
    const float radius = std::max(std::abs(input.coc_px(x, y)), 0.5f);
    const int reach = int(std::ceil(radius));
    const Rect area = Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(band);
    const float share = 1 / (std::numbers::pi_v<float> * radius * radius);
    const Rgba colour = share * input.colour(x, y);
    for (int v = area.y0; v < area.y1; ++v)
        for (int u = area.x0; u < area.x1; ++u) {
            const float cover =
                std::clamp(radius + 0.5f - std::hypot(float(u - x), float(v - y)), 0.0f, 1.0f);
            sums(u, v - band.y0) += cover * colour;
            weights(u, v - band.y0) += cover * share;
        }
}

}  // namespace

Picture weighted_scatter(const Input& input) {
    constexpr int kBand = 64;
    const int width = input.colour.width(), height = input.colour.height();
    Picture out(width, height);
    in_parallel((height + kBand - 1) / kBand, input.threads, [&](int i) {
        const Rect band = Rect{0, i * kBand, width, (i + 1) * kBand}.intersected(out.rect());
        Picture sums(width, band.height());
        Plane weights(width, band.height());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const int reach = int(std::ceil(std::max(std::abs(input.coc_px(x, y)), 0.5f)));
                if (y + reach >= band.y0 && y - reach < band.y1) add_disc(input, x, y, band, sums, weights);
            }
        for (int y = band.y0; y < band.y1; ++y)
            for (int x = 0; x < width; ++x)
                out(x, y) = sums(x, y - band.y0) * (1 / std::max(weights(x, y - band.y0), 1e-6f));
    });
    return out;
}

}  // namespace petzval::baselines
