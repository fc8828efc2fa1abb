#include "engine/samples/behind/plate.h"

#include "base/parallel.h"
#include "engine/samples/silhouettes/two_surfaces.h"

#include <algorithm>
#include <vector>

#include <climits>

namespace petzval::engine {
namespace {

using laws::kOpaque;

// The surfaces in front of the plate, as if they filled their pixels.
struct Fronts {
    const LitPicture& picture;
    View<const float> coc_px;
    const Mixtures& mixtures;
    const LitPicture& plate;
    View<const float> plate_px;

    // True if a surface at this radius is visible at (x, y) or beside it.
    bool touch(int x, int y, float radius_px) const {
        const Rect window = Rect{x - 1, y - 1, x + 2, y + 2}.intersected(coc_px.rect());
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u)
                if (shows(u, v, radius_px)) return true;
        return false;
    }

    // Colour of the surface with this radius around (x, y): from its pixels that touch no silhouette. A
    // thin object has none; then all of its pixels count, weighted by their difference from the plate.
    Guess colour(int x, int y, float radius_px) const {
        constexpr int kReach = 3;
        const Rect window =
            Rect{x - kReach, y - kReach, x + kReach + 1, y + kReach + 1}.intersected(coc_px.rect());
        Pool clean, mixed;
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u) {
                if (!shows(u, v, radius_px)) continue;
                const Rgba c = picture.dim(u, v);
                const float away = float((u - x) * (u - x) + (v - y) * (v - y)),
                            weight = 1 / (1 + away * away);
                if (!mixtures.at(u, v)) clean.add(c, weight);
                mixed.add(c, weight * (distance2(comparable(c), comparable(plate.dim(u, v))) + 1e-9f));
            }
        return clean.empty() ? mixed.empty() ? Guess{picture.dim(x, y), 0} : mixed.guess() : clean.guess();
    }

private:
    bool shows(int x, int y, float radius_px) const {
        constexpr float kOneSurfacePx = 1.5f;
        return is_before_plate(coc_px(x, y), plate_px(x, y)) &&
               std::abs(coc_px(x, y) - radius_px) <= kOneSurfacePx + 0.1f * std::abs(radius_px);
    }
};

// Pixels that a plate states in one row.
struct StatedRow {
    int count = 0, first = INT_MAX, last = -1;
    void add(int x) {
        ++count;
        first = std::min(first, x);
        last = x;
    }
};

// True if the plate states nearly all of a rectangle of some size: a whole frame, or a crop of one. Patches
// that were painted, or found in other frames, do not fill the rectangle around them.
bool fills_its_rectangle(const std::vector<StatedRow>& rows, int width) {
    constexpr double kFilled = 0.9, kLeastOfFrame = 0.05;
    double count = 0;
    Rect around{width, int(rows.size()), 0, 0};
    for (int y = 0; y < int(rows.size()); ++y) {
        const StatedRow& row = rows[std::size_t(y)];
        if (row.count == 0) continue;
        count += row.count;
        around = {std::min(around.x0, row.first), std::min(around.y0, y), std::max(around.x1, row.last + 1),
                  y + 1};
    }
    return !around.empty() && count >= kFilled * double(around.width()) * double(around.height()) &&
           count >= kLeastOfFrame * double(width) * double(rows.size());
}

}  // namespace

BackPicture back_picture(const StatedPicture& p, Workers& workers) {
    BackPicture back;
    const DeepPicture* const plate = p.behind;
    if (!plate || plate->empty() || (p.deep && !p.deep->empty())) return back;
    for (std::size_t i = 0; i + 1 < plate->first().size(); ++i)
        if (plate->first()[i + 1] - plate->first()[i] > 1) return back;
    const int width = p.colour.width(), height = p.colour.height();
    back.colour = Picture::uninitialised(width, height), back.coc_px = Plane::uninitialised(width, height);
    back.is_stated = Image<unsigned char>(width, height);
    std::vector<StatedRow> rows(static_cast<std::size_t>(height));
    parallel_for(height, workers, [&](int y) {
        for (int x = 0; x < width; ++x) {
            back.colour(x, y) = p.colour(x, y), back.coc_px(x, y) = p.radius_px(p.depth(x, y));
            const auto stated = plate->at(x, y);
            if (stated.empty()) continue;
            const Rgba colour = finite_colour(stated.front().colour);
            const float depth = stated.front().depth, radius = p.radius_px(depth);
            constexpr float kLeastCoverage = 0.5f;
            const bool opaque = p.colour(x, y).a >= kOpaque;
            if (opaque && colour.a < kLeastCoverage) continue;
            rows[std::size_t(y)].add(x);
            if (!is_same_or_in_front(p, depth, p.depth(x, y)) && !is_before_plate(back.coc_px(x, y), radius))
                continue;
            back.colour(x, y) = opaque ? colour * (1 / colour.a) : colour, back.coc_px(x, y) = radius;
            back.is_stated(x, y) = 1;
        }
    });
    back.covers = fills_its_rectangle(rows, width);
    return back;
}

void BackPicture::mark_out_of_sight(const CocSamples& left) {
    for (int y = 0; y < is_stated.height(); ++y)
        for (int x = 0; x < is_stated.width(); ++x) {
            const auto samples = CocSamplesView(left).at(x, y);
            if (is_stated(x, y) && !samples.empty() && is_before_plate(samples.back().coc_px, coc_px(x, y)))
                is_stated(x, y) = CleanPlate::kOutOfSight;
        }
}

void unmix_before_plate(Mixtures& mixtures, const LitPicture& picture, View<const float> coc_px,
                        const CleanPlate& plate, Workers& workers) {
    const LitPicture back{plate.colour, picture.dim_of};
    const Fronts front{picture, coc_px, mixtures, back, plate.coc_px};
    parallel_for(picture.colour.height(), workers, [&](int y) {
        for (int x = 0; x < picture.colour.width(); ++x) {
            Mixture* const at = mixtures.at(x, y);
            if (!plate.covers && !plate.is_stated(x, y)) continue;
            if (!at || is_before_plate(at->far_coc_px, plate.coc_px(x, y))) continue;
            Mixture& m = *at;
            m.far_light = {};
            // No background is mixed into this pixel.
            if (const Rgba whole = picture.colour(x, y); whole.a < kOpaque) {
                m.near_colour = whole, m.near_share = whole.a;
                continue;
            }
            const Rgba c = picture.dim(x, y), behind = back.dim(x, y);
            if (front.touch(x, y, m.near_coc_px))
                m.near_share = share_before(c, front.colour(x, y, m.near_coc_px), behind, m.share_by_shape,
                                            m.errors(picture));
            else
                m.near_share = 0, m.lights_near = false;  // both surfaces are part of the plate
            m.near_colour = light_only(c - (1 - m.near_share) * behind);
            if (m.lights_near) m.near_colour += picture.colour(x, y) - c;
        }
    });
}

}  // namespace petzval::engine
