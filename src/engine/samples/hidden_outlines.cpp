#include "engine/samples/hidden_outlines.h"

#include "base/parallel.h"
#include "engine/samples/known_surfaces.h"
#include "engine/samples/nearest_pixel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace petzval::engine {
namespace {

using Point = HiddenOutlines::Point;
using Outline = HiddenOutlines::Outline;

constexpr int kCell = 16;       // pixels on a side
constexpr int kLongestPx = 54;  // it goes on for; strips of a frame hold more around them
constexpr int kTracedPx = 12;   // of it, at most, tell how it goes on
constexpr int kLeastTracedPx = 5;

constexpr std::array<Point, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};  // each to the right of the last

enum class Side { Nearer, Same, Farther };

class OutlineFinder {
public:
    explicit OutlineFinder(View<const float> coc) : coc_(coc) {}

    // The outline that is hidden from the corner (x, y) of four pixels on.
    std::optional<Outline> outline_at(int x, int y) const {
        std::array<float, 4> met{coc_(x - 1, y - 1), coc_(x, y - 1), coc_(x - 1, y), coc_(x, y)};
        const auto [low, high] = std::minmax_element(met.begin(), met.end());
        if (one_surface(*low, *high)) return {};
        std::sort(met.begin(), met.end());
        for (const float own : {met[1], met[2]})
            if (side(met[0], own) == Side::Nearer && side(met[3], own) == Side::Farther)
                return goes_on({x, y}, own);
        return {};
    }

private:
    struct Middle {
        float x, y;  // of a side of a pixel, from where the outline is hidden
    };

    static Side side(float coc, float own) {
        if (one_surface(coc, own)) return Side::Same;
        return coc < own ? Side::Nearer : Side::Farther;
    }
    Side side(Point pixel, float own) const {
        return coc_.rect().contains(pixel.x, pixel.y) ? side(coc_(pixel.x, pixel.y), own) : Side::Nearer;
    }
    std::optional<Outline> goes_on(Point at, float own) const {
        std::array<Middle, kTracedPx> traced;
        bool same_is_right = false;
        const int count = trace(at, own, traced, same_is_right);
        for (const int n : {count, 8, kLeastTracedPx})
            if (n <= count && n >= kLeastTracedPx)
                if (auto line = straight(std::span(traced).first(std::size_t(n)))) {
                    line->at = at, line->coc_px = own;
                    // Traced the other way from how it goes on.
                    line->side = same_is_right ? -1.0f : 1.0f;
                    line->length_px = hidden_for(*line);
                    if (line->length_px <= 0) return {};
                    reach(*line);
                    return line;
                }
        return {};
    }
    // What it is asked about.
    static void reach(Outline& line) {
        constexpr int kLeastPx = 16, kMorePx = 8;
        const float half = 0.5f * line.length_px;
        line.middle = {line.at.x + nearest_pixel(half * line.into_x),
                       line.at.y + nearest_pixel(half * line.into_y)};
        line.around_px = std::max(kLeastPx, int(half) + kMorePx);
    }
    // Along the outline from where it is hidden on: the middles of its pixels' sides. How many there are.
    int trace(Point at, float own, std::array<Middle, kTracedPx>& traced, bool& same_is_right) const {
        for (int k = 0; k < 4; ++k) {
            const auto [right, left] = beside(at, kSteps[std::size_t(k)]);
            const Side r = side(right, own), l = side(left, own);
            if ((r == Side::Same && l == Side::Farther) || (l == Side::Same && r == Side::Farther)) {
                same_is_right = r == Side::Same;
                return follow(at, k, own, same_is_right, traced);
            }
        }
        return 0;
    }
    struct Beside {
        Point right, left;
    };
    // The pixels to both sides of a step from a corner (y points down).
    static Beside beside(Point at, Point step) {
        if (step.x > 0) return {{at.x, at.y}, {at.x, at.y - 1}};
        if (step.x < 0) return {{at.x - 1, at.y - 1}, {at.x - 1, at.y}};
        if (step.y > 0) return {{at.x - 1, at.y}, {at.x, at.y}};
        return {{at.x, at.y - 1}, {at.x - 1, at.y - 1}};
    }
    int follow(Point at, int k, float own, bool same_is_right, std::array<Middle, kTracedPx>& traced) const {
        const Point begin = at;
        for (int n = 0; n < kTracedPx; ++n) {
            const Point step = kSteps[std::size_t(k)];
            traced[std::size_t(n)] = {float(at.x - begin.x) + 0.5f * float(step.x),
                                      float(at.y - begin.y) + 0.5f * float(step.y)};
            at = {at.x + step.x, at.y + step.y};
            const auto [right, left] = beside(at, step);
            const Side ahead = side(same_is_right ? right : left, own),
                       other = side(same_is_right ? left : right, own);
            if (ahead == Side::Nearer || other == Side::Nearer) return n + 1;
            const int to_same = same_is_right ? 1 : 3;  // turns
            if (ahead == Side::Farther)
                k = (k + to_same) % 4;
            else if (other == Side::Same)
                k = (k + 4 - to_same) % 4;
        }
        return kTracedPx;
    }

    // The line along them, from the first of them on.
    static std::optional<Outline> straight(std::span<const Middle> traced) {
        constexpr float kStraightPx = 0.8f;
        float x = 0, y = 0, xx = 0, xy = 0, yy = 0;
        for (const Middle& m : traced) x += m.x, y += m.y;
        x /= float(traced.size()), y /= float(traced.size());
        for (const Middle& m : traced)
            xx += (m.x - x) * (m.x - x), xy += (m.x - x) * (m.y - y), yy += (m.y - y) * (m.y - y);
        const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
        float along_x = std::cos(angle), along_y = std::sin(angle);
        if (x * along_x + y * along_y > 0) along_x = -along_x, along_y = -along_y;
        for (const Middle& m : traced)
            if (std::abs((m.x - x) * along_y - (m.y - y) * along_x) > kStraightPx) return {};
        const float to_corner = -(x * along_x + y * along_y);
        Outline line{};
        line.off_x = x + to_corner * along_x, line.off_y = y + to_corner * along_y;
        line.into_x = along_x, line.into_y = along_y;
        return line;
    }
    // How far something nearer goes on before it.
    float hidden_for(const Outline& line) const {
        constexpr float kMorePx = 1.5f;
        for (int t = 1; t <= kLongestPx; ++t) {
            const float along = float(t) + 0.5f;
            const Point at{line.at.x + int(std::floor(line.off_x + along * line.into_x)),
                           line.at.y + int(std::floor(line.off_y + along * line.into_y))};
            if (side(at, line.coc_px) != Side::Nearer) return t == 1 ? 0 : float(t) + kMorePx;
        }
        return float(kLongestPx);
    }

    View<const float> coc_;
};

}  // namespace

HiddenOutlines::HiddenOutlines(View<const float> coc, Workers& workers) {
    if (coc.width() < 2 || coc.height() < 2) return;
    const OutlineFinder finder(coc);
    std::vector<std::vector<Outline>> rows(static_cast<std::size_t>(coc.height()));
    parallel_for(coc.height() - 1, workers, [&](int row) {
        for (int x = 1; x < coc.width(); ++x)
            if (const auto outline = finder.outline_at(x, row + 1))
                rows[std::size_t(row)].push_back(*outline);
    });
    for (const auto& row : rows) outlines_.insert(outlines_.end(), row.begin(), row.end());
    sort_into_cells(coc.width(), coc.height());
}

void HiddenOutlines::sort_into_cells(int width, int height) {
    columns_ = (width + kCell - 1) / kCell;
    const int rows = (height + kCell - 1) / kCell;
    near_.resize(std::size_t(columns_) * std::size_t(rows));
    const auto cell = [](int at, int cells) { return std::clamp(at / kCell, 0, cells - 1); };
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
        const Outline& o = outlines_[i];
        for (int v = cell(o.middle.y - o.around_px, rows); v <= cell(o.middle.y + o.around_px, rows); ++v)
            for (int u = cell(o.middle.x - o.around_px, columns_);
                 u <= cell(o.middle.x + o.around_px, columns_); ++u)
                near_[std::size_t(v * columns_ + u)].push_back(int(i));
    }
}

template <typename Concerns>
float HiddenOutlines::open(Point shown, Point hidden, float from, const Concerns& concerns) const {
    constexpr float kSoftPx = 0.5f, kBeforePx = 1.5f;
    if (outlines_.empty()) return 1;
    float open = 1;
    for (const int i : near_[std::size_t(hidden.y / kCell * columns_ + hidden.x / kCell)]) {
        const Outline& o = outlines_[std::size_t(i)];
        if (!concerns(o.coc_px)) continue;
        // (Told from here and not from the cell, so that strips of a frame agree.)
        if (std::max(std::abs(hidden.x - o.middle.x), std::abs(hidden.y - o.middle.y)) > o.around_px)
            continue;
        const auto x = [&](Point p) { return float(p.x - o.at.x) + 0.5f - o.off_x; };
        const auto y = [&](Point p) { return float(p.y - o.at.y) + 0.5f - o.off_y; };
        const auto side = [&](Point p) { return from * o.side * (y(p) * o.into_x - x(p) * o.into_y); };
        const auto ahead = [&](Point p) { return x(p) * o.into_x + y(p) * o.into_y; };
        const float a = side(hidden), b = side(shown);
        if (a >= 0 || b <= 0) continue;
        const float met = (ahead(hidden) * b - ahead(shown) * a) / (b - a);
        if (met < -kBeforePx || met > o.length_px) continue;
        open *= 1 - std::min(1.0f, -a / kSoftPx);
    }
    return open;
}

float HiddenOutlines::within(Point shown, Point hidden, float coc_px) const {
    return open(shown, hidden, 1, [&](float own) { return one_surface(own, coc_px); });
}

float HiddenOutlines::unhidden(Point shown, Point hidden, float coc_px) const {
    return open(shown, hidden, -1, [&](float own) { return own < coc_px && !one_surface(own, coc_px); });
}

}  // namespace petzval::engine
