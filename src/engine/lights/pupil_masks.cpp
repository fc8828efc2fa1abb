#include "engine/lights/pupil_masks.h"

#include "base/parallel.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace petzval::engine {
namespace {

constexpr float kWidestPupil = 1.0f - 1.0f / PupilMask::kSide;  // where the outermost points of the grid lie
// A square whose radii differ by less than this share of the way to it hides as if they were one.
constexpr float kNarrow = 0.06f;

// Grid points between two places on an axis of the pupil, as bits.
unsigned points(float from, float to) {
    constexpr float kHalf = 0.5f * PupilMask::kSide, kEnd = PupilMask::kSide;
    const float first = std::clamp((from + 1) * kHalf - 0.5f, 0.0f, kEnd);
    const float last = std::clamp((to + 1) * kHalf - 0.5f, -1.0f, kEnd - 1);
    const int begin = PupilMask::kSide - int(kEnd - first),
              end = int(last + 1);  // rounded up, down and past it
    return begin < end ? (1u << end) - (1u << begin) : 0;
}

// Every row of the grid that `rows` names, with the columns that `columns` names.
std::uint64_t grid(unsigned columns, unsigned rows) {
    // The bits of `rows`, each the lowest of its byte: bit i goes up by 7 i. (The last one apart, since it
    // would meet the first on its way.)
    const std::uint64_t spread = ((rows & 127) * std::uint64_t(0x0002040810204081) & 0x0101010101010101u) |
                                 std::uint64_t(rows >> 7) << 56;
    return spread * columns;
}

constexpr float kNoSurface = 1e30f;  // the radius of a pixel that hides nothing

// The radius of the second opaque surface of a pixel, if something lies behind that.
float second_surface(std::span<const CocSample> samples, float visible_px) {
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        if (samples[i].colour.a >= laws::kOpaque && samples[i].coc_px - visible_px >= laws::kJumpPx)
            return samples[i].coc_px;
    return kNoSurface;
}

// Radii of second surfaces, and of the visible ones beside them, which may continue them. Empty: there are
// none.
Plane second_surfaces(const EngineView& input) {
    const CocSamplesView& deep = input.samples.deep;
    const View<const float> visible = input.samples.coc_px;
    if (deep.empty()) return {};
    Plane found(input.width(), input.height(), kNoSurface);
    bool any = false;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) {
            found(x, y) = second_surface(deep.at(x, y), visible(x, y));
            any = any || found(x, y) < kNoSurface;
        }
    if (!any) return {};
    Plane radii = found.clone();
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) {
            if (found(x, y) == kNoSurface) continue;
            for (const auto& [u, v] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}})
                if (found.rect().contains(u, v) && found(u, v) == kNoSurface) radii(u, v) = visible(u, v);
        }
    return radii;
}

}  // namespace

void PupilMasks::Node::include(const Node& other) {
    nearest = std::min(nearest, other.nearest), farthest = std::max(farthest, other.farthest);
    is_whole = is_whole && other.is_whole;
    bins |= other.bins;
}

int PupilMasks::bin(float coc_px) const {
    return int(std::clamp((coc_px - in_.samples.nearest_coc_px) * bins_per_px_, 0.0f, 63.0f));
}

// Up to the middle between it and each of its neighbours on one surface, so that a surface has no cracks.
PupilMasks::Node PupilMasks::pixel(int x, int y) const {
    const View<const float> coc = coc_px_;
    const float own = coc(x, y);
    if (own == kNoSurface) return {own, own, false, 0};
    Node node{own, own, true, 0};
    const auto meet = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= coc.width() || v >= coc.height()) return;
        const float there = coc(u, v), middle = 0.5f * (own + there);
        if (std::abs(there - own) >= laws::kJumpPx)
            node.is_whole = false;
        else
            node.nearest = std::min(node.nearest, middle), node.farthest = std::max(node.farthest, middle);
    };
    meet(x - 1, y), meet(x + 1, y), meet(x, y - 1), meet(x, y + 1);
    node.bins = (std::uint64_t(2) << bin(node.farthest)) - (std::uint64_t(1) << bin(node.nearest));
    return node;
}

PupilMasks::PupilMasks(const EngineView& input) : PupilMasks(input, input.samples.coc_px) {
    second_px_ = second_surfaces(input);
    if (second_px_.width() > 0) second_.reset(new PupilMasks(input, second_px_));
}

PupilMasks::PupilMasks(const EngineView& input, View<const float> coc_px) : in_(input), coc_px_(coc_px) {
    const float range = input.samples.farthest_coc_px - input.samples.nearest_coc_px;
    bins_per_px_ = range > 0 ? 64 / range : 0;
    for (int width = input.width(), height = input.height(); width > 1 || height > 1;) {
        const int level = top(), below_width = width, below_height = height;
        width = (width + 1) / 2, height = (height + 1) / 2;
        Image<Node> nodes(width, height);
        parallel_for(height, *input.services.workers, [&](int y) {
            for (int x = 0; x < width; ++x)
                for (int v = 2 * y; v < std::min(2 * y + 2, below_height); ++v)
                    for (int u = 2 * x; u < std::min(2 * x + 2, below_width); ++u)
                        nodes(x, y).include(node(level, u, v));
        });
        levels_.push_back(std::move(nodes));
    }
}

// The sides of a square of pixels as a light sees them.
struct PupilMasks::Square {
    float left, top, right, bottom;  // from the light; vertically as wide as a pixel
    // Pupil points behind the square wherever it stands between two radii, given as 1 / (way to them).
    std::uint64_t anywhere(float close, float far) const {
        const unsigned columns = points(left * (left < 0 ? close : far), right * (right < 0 ? far : close));
        return columns == 0 ? 0
                            : grid(columns, points(top * (top < 0 ? close : far),
                                                   bottom * (bottom < 0 ? far : close)));
    }
    // Those behind it all the way.
    std::uint64_t throughout(float close, float far) const {
        return grid(points(left * (left < 0 ? far : close), right * (right < 0 ? close : far)),
                    points(top * (top < 0 ? far : close), bottom * (bottom < 0 ? close : far)));
    }
};

PupilMasks::Behind PupilMasks::behind(const Light& light, int level, int x, int y, const Node& node) const {
    const Rect pixels =
        Rect{x << level, y << level, (x + 1) << level, (y + 1) << level}.intersected(coc_px_.rect());
    const float per_row = 1 / float(in_.lens.pixel_aspect);
    Square square{float(pixels.x0) - light.x, (float(pixels.y0) - light.y) * per_row,
                  float(pixels.x1) - light.x, (float(pixels.y1) - light.y) * per_row};
    // Surfaces that touch an open edge of the picture continue beyond it.
    constexpr float kBeyondPx = 1e6f;
    const OpenEdges& open = in_.window.open_edges;
    if (open.left && pixels.x0 == 0) square.left = -kBeyondPx;
    if (open.top && pixels.y0 == 0) square.top = -kBeyondPx;
    if (open.right && pixels.x1 == in_.width()) square.right = kBeyondPx;
    if (open.bottom && pixels.y1 == in_.height()) square.bottom = kBeyondPx;
    const float limit = light.coc_px - laws::kOwnPupilPx;
    Behind found;
    if (node.farthest < limit) {
        const float close = 1 / (light.coc_px - node.farthest), far = 1 / (light.coc_px - node.nearest);
        const bool narrow = level == 0 || (node.farthest - node.nearest) * close <= kNarrow;
        if (narrow || node.is_whole) {
            found.all = square.anywhere(close, far);
            // One surface stops every ray that stays within the square from its farthest to its nearest
            // radius.
            if (found.all) found.surely = narrow ? found.all : square.throughout(close, far);
            return found;
        }
    }
    // Surfaces apart, each between the radii of a run of bins.
    for (std::uint64_t bins = node.bins; bins;) {
        const int first = std::countr_zero(bins), count = std::countr_one(bins >> first);
        const float nearest =
            std::max(node.nearest, in_.samples.nearest_coc_px + float(first) / bins_per_px_);
        const float farthest = std::min(
            {node.farthest, limit, in_.samples.nearest_coc_px + float(first + count) / bins_per_px_});
        if (nearest >= limit) break;
        found.all |= square.anywhere(1 / (light.coc_px - farthest), 1 / (light.coc_px - nearest));
        if (first + count == 64) break;
        bins &= ~std::uint64_t(0) << (first + count);
    }
    if (level == 0) found.surely = found.all;
    return found;
}

void PupilMasks::hide(const Light& light, int level, int x, int y, std::uint64_t& seen) const {
    const Node here = node(level, x, y);
    if (!laws::is_in_front(here.nearest, light.coc_px, laws::kOwnPupilPx)) return;
    const Behind found = behind(light, level, x, y, here);
    seen &= ~found.surely;
    if (level == 0 || !(found.all & seen)) return;
    const int width = (in_.width() - 1) >> (level - 1), height = (in_.height() - 1) >> (level - 1);
    hide_four(light, level - 1, {2 * x, 2 * y, std::min(2 * x + 1, width), std::min(2 * y + 1, height)},
              seen);
}

void PupilMasks::hide_four(const Light& light, int level, const Rect& squares, std::uint64_t& seen) const {
    // Searches at the light first: occluders close to its path hide most, and end the search.
    const float size = float(1 << level);
    const bool right = light.x >= float(squares.x1) * size, down = light.y >= float(squares.y1) * size;
    for (int j = 0; j <= squares.height() && seen; ++j)
        for (int i = 0; i <= squares.width() && seen; ++i)
            hide(light, level, right ? squares.x1 - i : squares.x0 + i,
                 down ? squares.y1 - j : squares.y0 + j, seen);
}

PupilMask PupilMasks::mask(float x, float y, float coc_px) const {
    PupilMask mask;
    const Light light{x, y, coc_px};
    hide_all(light, mask.seen);
    // Nothing lies behind a visible surface that is itself behind the light.
    if (second_ && !mask.is_open() && !mask.is_closed()) second_->hide_all(light, mask.seen);
    return mask;
}

void PupilMasks::hide_all(const Light& light, std::uint64_t& seen) const {
    if (!laws::is_in_front(in_.samples.nearest_coc_px, light.coc_px, laws::kOwnPupilPx)) return;
    const float reach = (light.coc_px - in_.samples.nearest_coc_px) * kWidestPupil *
                        std::max(1.0f, float(in_.lens.pixel_aspect));
    // Squares so large that two by two hold all that is in reach.
    const int level = std::min(1 + int(std::log2(std::max(1.0f, 2 * reach))), top());
    const auto square = [&](float at, int pixels) {
        return int(std::clamp(std::floor(at), 0.0f, float(pixels - 1))) >> level;
    };
    hide_four(light, level,
              {square(light.x - reach, in_.width()), square(light.y - reach, in_.height()),
               square(light.x + reach, in_.width()), square(light.y + reach, in_.height())},
              seen);
}

}  // namespace petzval::engine
