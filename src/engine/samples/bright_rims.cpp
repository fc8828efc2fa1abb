#include "engine/samples/bright_rims.h"

#include "base/parallel.h"
#include "engine/samples/two_surfaces.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kApartPx = 1.5f;  // surfaces whose radii differ by less are blurred alike
constexpr float kBrighter = 2;
constexpr int kCleanReach = 3;  // pixels; with those beside them, BrightRims::kReachPx

class Finder {
public:
    Finder(View<const Rgba> colour, View<const float> coc_px) : colour_(colour), coc_px_(coc_px) {}

    std::vector<BrightRim> in_row(int y) const {
        const int width = coc_px_.width();
        const float* const rows[3] = {coc_px_.row(std::max(0, y - 1)), coc_px_.row(y),
                                      coc_px_.row(std::min(coc_px_.height() - 1, y + 1))};
        std::vector<float> nearest(static_cast<std::size_t>(width));
        for (int x = 0; x < width; ++x)
            nearest[std::size_t(x)] = std::min({rows[0][x], rows[1][x], rows[2][x]});
        std::vector<BrightRim> rims;
        for (int x = 0; x < width; ++x) {
            const std::size_t before = std::size_t(std::max(0, x - 1)),
                              after = std::size_t(std::min(width - 1, x + 1));
            if (rows[1][x] - std::min({nearest[before], nearest[std::size_t(x)], nearest[after]}) <= kApartPx)
                continue;
            if (const auto rim = taken_apart(x, y)) rims.push_back(*rim);
        }
        return rims;
    }

private:
    Rect around(int x, int y, int reach) const {
        return Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(coc_px_.rect());
    }

    bool is_clean(int x, int y) const {
        const Rect window = around(x, y, 1);
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u)
                if (std::abs(coc_px_(u, v) - coc_px_(x, y)) > kApartPx) return false;
        return true;
    }

    std::optional<BrightRim> taken_apart(int x, int y) const {
        const float coc = coc_px_(x, y), own = luminance(colour_(x, y));
        float peak = 0;
        BrightRim rim;
        rim.x = x;
        const Rect beside = around(x, y, 1);
        for (int v = beside.y0; v < beside.y1; ++v)
            for (int u = beside.x0; u < beside.x1; ++u)
                if (coc - coc_px_(u, v) > kApartPx && luminance(colour_(u, v)) > peak)
                    peak = luminance(colour_(u, v)), rim.near_coc_px = coc_px_(u, v);
        if (!(peak >= kBrighter * own)) return {};
        Pool clean;
        const Rect window = around(x, y, kCleanReach);
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u) {
                if (std::abs(coc_px_(u, v) - coc) > kApartPx || !is_clean(u, v)) continue;
                if (kBrighter * luminance(colour_(u, v)) > own) return {};
                clean.add(colour_(u, v), 1 / float(1 + (u - x) * (u - x) + (v - y) * (v - y)));
            }
        if (clean.empty()) return {};
        rim.far = clean.guess().colour;
        const float far = luminance(rim.far);
        rim.share = (own - far) / (peak - far);
        rim.near = light_only(colour_(x, y) - (1 - rim.share) * rim.far);
        return rim;
    }

    View<const Rgba> colour_;
    View<const float> coc_px_;
};

}  // namespace

BrightRims BrightRims::find(View<const Rgba> colour, View<const float> coc_px, Workers& workers) {
    const Finder finder(colour, coc_px);
    const int height = coc_px.height();
    std::vector<std::vector<BrightRim>> rows(static_cast<std::size_t>(height));
    parallel_for(height, workers, [&](int y) { rows[std::size_t(y)] = finder.in_row(y); });
    BrightRims found;
    if (std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.empty(); })) return found;
    found.index_ = Image<int>(coc_px.width(), height, -1);
    for (int y = 0; y < height; ++y)
        for (const BrightRim& rim : rows[std::size_t(y)]) {
            found.index_(rim.x, y) = int(found.rims_.size());
            found.rims_.push_back(rim);
        }
    return found;
}

Plane BrightRims::radii(View<const float> coc_px) const {
    Plane radii = Plane::uninitialised(coc_px.width(), coc_px.height());
    for (int y = 0; y < coc_px.height(); ++y)
        for (int x = 0; x < coc_px.width(); ++x) {
            const BrightRim* const rim = at(x, y);
            radii(x, y) = rim ? rim->near_coc_px : coc_px(x, y);
        }
    return radii;
}

}  // namespace petzval::engine
