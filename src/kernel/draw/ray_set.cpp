#include "kernel/draw/ray_set.h"

#include "kernel/draw/pupil.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

double importance(const colour::SpectralBand& b) { return std::abs(b.r) + std::abs(b.g) + std::abs(b.b); }

// expected: what each channel's weights should come to, about.
void balance(std::vector<PupilRay>& rays, double expected) {
    double r = 0, g = 0, b = 0, a = 0;
    for (const PupilRay& ray : rays) {
        const Rgba& w = ray.weight;
        r += double(w.r), g += double(w.g), b += double(w.b), a += double(w.a);
    }
    // Few rays may miss the wavelengths of a channel, or meet more of its negative ones.
    const bool too_few = !(std::min({r, g, b, a}) >= 0.5 * expected) || expected <= 0;
    const float even = 1 / float(rays.size());
    for (PupilRay& ray : rays) {
        Rgba& w = ray.weight;
        if (too_few)
            w = {even, even, even, even};
        else
            w = {float(double(w.r) / r), float(double(w.g) / g), float(double(w.b) / b),
                 float(double(w.a) / a)};
    }
}

}  // namespace

std::vector<PupilRay> spread_rays(const std::vector<Point>& outline,
                                  const std::vector<colour::SpectralBand>& bands, int count,
                                  std::uint64_t seed,
                                  const std::function<RayLanding(std::size_t, Point)>& landing) {
    std::vector<double> up_to;
    double sum = 0;
    for (const colour::SpectralBand& b : bands) up_to.push_back(sum += importance(b));
    std::vector<PupilRay> rays;
    double expected = 0;
    for (const PupilPoint& p : spread_evenly(outline, count, seed)) {
        const auto found = std::upper_bound(up_to.begin(), up_to.end() - 1, p.third * sum);
        const std::size_t i = std::size_t(found - up_to.begin());
        const RayLanding l = landing(i, p.place);
        const colour::SpectralBand& b = bands[i];
        expected += l.light;
        const double scale = l.light * sum / importance(b);
        rays.push_back(
            {float(l.per_coc.x),
             float(l.per_coc.y),
             float(l.offset_px.x),
             float(l.offset_px.y),
             {float(b.r * scale), float(b.g * scale), float(b.b * scale), float(b.luminance * scale)}});
    }
    balance(rays, expected);
    return rays;
}

}  // namespace petzval::kernel
