#include "engine/sprites_shadow.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kOwnSurfacePx = 1;  // what is nearer by less is the light's own surface
constexpr float kJumpPx = 1;        // from pixel to pixel: another surface
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

}  // namespace

PupilMask::Between::Between(float place) {
    const float p = std::clamp((place + 1) / 2 * kSide - 0.5f, 0.0f, float(kSide - 1));
    cell = std::min(int(p), kSide - 2);
    share = p - float(cell);
}

void SpriteShadows::Node::include(const Node& other) {
    nearest = std::min(nearest, other.nearest), farthest = std::max(farthest, other.farthest);
    is_whole = is_whole && other.is_whole;
}

// Up to the middle between it and each of its neighbours on one surface, so that a surface has no cracks.
SpriteShadows::Node SpriteShadows::pixel(int x, int y) const {
    const View<const float> coc = in_.coc_px;
    const float own = coc(x, y);
    Node node{own, own, true};
    const auto meet = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= coc.width() || v >= coc.height()) return;
        const float there = coc(u, v), middle = 0.5f * (own + there);
        if (std::abs(there - own) >= kJumpPx)
            node.is_whole = false;
        else
            node.nearest = std::min(node.nearest, middle), node.farthest = std::max(node.farthest, middle);
    };
    meet(x - 1, y), meet(x + 1, y), meet(x, y - 1), meet(x, y + 1);
    return node;
}

SpriteShadows::SpriteShadows(const Input& input) : in_(input) {
    for (int width = input.width(), height = input.height(); width > 1 || height > 1;) {
        const int level = top(), below_width = width, below_height = height;
        width = (width + 1) / 2, height = (height + 1) / 2;
        Image<Node> nodes(width, height);
        parallel_for(height, input.threads, [&](int y) {
            for (int x = 0; x < width; ++x)
                for (int v = 2 * y; v < std::min(2 * y + 2, below_height); ++v)
                    for (int u = 2 * x; u < std::min(2 * x + 2, below_width); ++u)
                        nodes(x, y).include(node(level, u, v));
        });
        levels_.push_back(std::move(nodes));
    }
}

SpriteShadows::Behind SpriteShadows::behind(const Light& light, int level, int x, int y,
                                            const Node& node) const {
    const Rect pixels =
        Rect{x << level, y << level, (x + 1) << level, (y + 1) << level}.intersected(in_.coc_px.rect());
    const float per_row = 1 / float(in_.pixel_aspect);
    const float left = float(pixels.x0) - light.x, right = float(pixels.x1) - light.x;
    const float top = (float(pixels.y0) - light.y) * per_row, bottom = (float(pixels.y1) - light.y) * per_row;
    // Of a whole surface every ray is stopped that lies within the square all the way from its farthest to
    // its nearest radius.
    const float close = 1 / (light.coc_px - std::min(node.farthest, light.coc_px - kOwnSurfacePx));
    const float far = 1 / (light.coc_px - node.nearest);
    const auto low = [&](float edge, float a, float b) { return edge * (edge < 0 ? a : b); };
    Behind found;
    const unsigned columns = points(low(left, close, far), low(right, far, close));
    if (columns == 0) return found;
    found.all = grid(columns, points(low(top, close, far), low(bottom, far, close)));
    if (node.farthest >= light.coc_px - kOwnSurfacePx) return found;
    const float spread = node.farthest - node.nearest;
    if (level == 0 || spread * close <= kNarrow)
        found.surely = found.all;
    else if (node.is_whole && found.all)
        found.surely = grid(points(low(left, far, close), low(right, close, far)),
                            points(low(top, far, close), low(bottom, close, far)));
    return found;
}

void SpriteShadows::hide(const Light& light, int level, int x, int y, std::uint64_t& seen) const {
    const Node here = node(level, x, y);
    if (here.nearest >= light.coc_px - kOwnSurfacePx) return;
    const Behind found = behind(light, level, x, y, here);
    seen &= ~found.surely;
    if (level == 0 || !(found.all & seen)) return;
    const int below_width = (in_.width() + (1 << (level - 1)) - 1) >> (level - 1),
              below_height = (in_.height() + (1 << (level - 1)) - 1) >> (level - 1);
    for (int v = 2 * y; v < std::min(2 * y + 2, below_height); ++v)
        for (int u = 2 * x; u < std::min(2 * x + 2, below_width); ++u) hide(light, level - 1, u, v, seen);
}

PupilMask SpriteShadows::mask(float x, float y, float coc_px) const {
    PupilMask mask;
    if (in_.nearest_coc_px >= coc_px - kOwnSurfacePx) return mask;
    const float reach =
        (coc_px - in_.nearest_coc_px) * kWidestPupil * std::max(1.0f, float(in_.pixel_aspect));
    // Squares so large that few of them are in reach.
    const int level = std::clamp(int(std::log2(std::max(1.0f, reach))), 0, top());
    const auto square = [&](float at, int pixels) {
        return std::clamp(int(std::floor(at)), 0, pixels - 1) >> level;
    };
    const int x0 = square(x - reach, in_.width()), x1 = square(x + reach, in_.width());
    const int y0 = square(y - reach, in_.height()), y1 = square(y + reach, in_.height());
    for (int v = y0; v <= y1; ++v)
        for (int u = x0; u <= x1; ++u) hide({x, y, coc_px}, level, u, v, mask.seen);
    return mask;
}

}  // namespace petzval::engine
