#include "petzval/dynamic_range.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace petzval {
namespace {

class Shoulder {
public:
    explicit Shoulder(const HighlightExpansion& e)
        : knee_(e.knee), peak_(e.peak), bend_(1 - (1 - e.knee) / (e.peak - e.knee)) {}

    double expanded(double v) const {
        if (v <= knee_) return v;
        if (v >= 1) return peak_ * v;
        const double s = (v - knee_) / (1 - knee_);
        return knee_ + (1 - knee_) * s / (1 - bend_ * s);
    }
    double compressed(double light) const {
        if (light <= knee_) return light;
        if (light >= peak_) return light / peak_;
        const double t = (light - knee_) / (1 - knee_);
        return knee_ + (1 - knee_) * t / (1 + bend_ * t);
    }

private:
    double knee_, peak_, bend_;
};

// `curve` on the largest channel of the colour without alpha; the others keep their ratios to it.
template <typename Curve>
Rgba scaled(Rgba c, Curve curve) {
    const double largest = double(std::max({c.r, c.g, c.b}));
    const double alpha = double(c.a);
    if (!(largest > 0) || !(alpha > 0) || !std::isfinite(largest)) return c;
    const float factor = float(curve(largest / alpha) * alpha / largest);
    return {c.r * factor, c.g * factor, c.b * factor, c.a};
}

constexpr double kTolerance = 1.05;  // what resampling may leave above 1

}  // namespace

Result<Picture> expand_highlights(View<const Rgba> plate, const HighlightExpansion& expansion) {
    if (!(expansion.knee >= 0 && expansion.knee < 1))
        return Error{ErrorCode::InvalidArgument,
                     "the knee of plate.expand_highlights must lie between 0 and 1"};
    if (!(expansion.peak > 1 && expansion.peak <= 1e6))
        return Error{ErrorCode::InvalidArgument, "plate.peak must be more than 1, at most 1000000"};
    const Shoulder shoulder(expansion);
    Picture out = Picture::uninitialised(plate.width(), plate.height());
    for (int y = 0; y < plate.height(); ++y)
        for (int x = 0; x < plate.width(); ++x) {
            const Rgba c = plate(x, y);
            const float brightest = std::max({c.r, c.g, c.b});
            if (double(brightest) > kTolerance && std::isfinite(brightest)) {
                std::ostringstream text;
                text << "plate.expand_highlights is for plates that end at 1; this picture has light of "
                     << brightest << ", so it needs no expansion";
                return Error{ErrorCode::InvalidArgument, text.str()};
            }
            out(x, y) = scaled(c, [&](double v) { return shoulder.expanded(v); });
        }
    return out;
}

Picture compress_highlights(View<const Rgba> blurred, View<const Rgba> expanded, View<const Rgba> plate,
                            const HighlightExpansion& expansion) {
    const Shoulder shoulder(expansion);
    Picture out = Picture::uninitialised(blurred.width(), blurred.height());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out(x, y) = blurred(x, y) == expanded(x, y)
                            ? plate(x, y)
                            : scaled(blurred(x, y), [&](double v) { return shoulder.compressed(v); });
    return out;
}

}  // namespace petzval
