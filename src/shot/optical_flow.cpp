#include "shot/optical_flow.h"

#include "laws/surfaces.h"
#include "shot/landing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace petzval::shot {
namespace {

constexpr int kCoarsestSide = 24;    // cells of the coarsest level, at least
constexpr int kSearch = 4;           // cells to each side on the coarsest level
constexpr int kWindow = 2;           // cells to each side that are compared
constexpr float kStiffness = 0.01f;  // cost of a cell's distance from the motion that was guessed
constexpr float kKept = 0.8f;        // share of a node's motion that the next node of its surface takes over

// A picture with cells 2^n pixels wide: light in stops, depth in metres.
struct Level {
    Plane stops, depth;
};

bool one_surface(float a, float b) {
    return laws::same_surface_by_depth(kOneSurface, a, b) || (std::isinf(a) && std::isinf(b));
}

Level finest(const DepthPicture& picture, Workers& workers) {
    constexpr float kDark = 1 / 64.0f;  // noise of less light is not a texture
    Level level{Plane(picture.colour.width(), picture.colour.height()),
                Plane(picture.depth.width(), picture.depth.height())};
    for_rows(level.stops.height(), workers, [&](int y) {
        for (int x = 0; x < level.stops.width(); ++x) {
            level.stops(x, y) = std::log2(std::max(0.0f, luminance(picture.colour(x, y))) + kDark);
            level.depth(x, y) = picture.depth(x, y);
        }
    });
    return level;
}

// A cell has the depth of its first pixel, and the mean light of those of its four that lie on its surface.
Level coarser(const Level& fine) {
    const int width = fine.stops.width() / 2, height = fine.stops.height() / 2;
    Level level{Plane(width, height), Plane(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float depth = fine.depth(2 * x, 2 * y);
            float sum = 0, count = 0;
            for (int v = 2 * y; v < 2 * y + 2; ++v)
                for (int u = 2 * x; u < 2 * x + 2; ++u)
                    if ((u == 2 * x && v == 2 * y) || one_surface(depth, fine.depth(u, v))) {
                        sum += fine.stops(u, v);
                        count += 1;
                    }
            level.stops(x, y) = sum / count;
            level.depth(x, y) = depth;
        }
    return level;
}

std::vector<Level> pyramid(const DepthPicture& picture, Workers& workers) {
    std::vector<Level> levels;
    levels.push_back(finest(picture, workers));
    while (std::min(levels.back().stops.width(), levels.back().stops.height()) >= 2 * kCoarsestSide)
        levels.push_back(coarser(levels.back()));
    return levels;
}

struct Match {
    float x = 0, y = 0;  // cells of its level
    float cost = 0;      // 0…1
    float texture = 0;   // stops by which the light of the window changes from cell to cell
};

class Matching {
public:
    Matching(const Level& from, const Level& to) : from_(from), to_(to) {}

    // The cells around one that lie on its surface.
    struct Cell {
        int x, y;
        float depth, stops;
    };
    struct Window {
        int x = 0, y = 0, count = 0;
        std::array<Cell, std::size_t(2 * kWindow + 1) * (2 * kWindow + 1)> cells;
    };
    Window window(int x, int y) const {
        Window window{.x = x, .y = y, .count = 0, .cells = {}};
        const View<const float> depths = from_.depth, stops = from_.stops;
        const float own = depths(x, y);
        for (int v = std::max(0, y - kWindow); v <= std::min(stops.height() - 1, y + kWindow); ++v)
            for (int u = std::max(0, x - kWindow); u <= std::min(stops.width() - 1, x + kWindow); ++u)
                if ((u == x && v == y) || one_surface(own, depths(u, v)))
                    window.cells[std::size_t(window.count++)] = {u, v, depths(u, v), stops(u, v)};
        return window;
    }

    // Mean cost of a window that moves by dx, dy.
    float cost(const Window& window, int dx, int dy) const {
        float sum = 0;
        for (int i = 0; i < window.count; ++i) {
            const Cell& cell = window.cells[std::size_t(i)];
            sum += cost_of_cell(cell.depth, cell.stops, cell.x + dx, cell.y + dy);
        }
        return sum / float(window.count);
    }

    // The best of motions around x, y: one step after the other goes to the best of eight neighbours.
    Match improved(const Window& window, std::pair<int, int> guess, float guessed_cost) const {
        Match best{float(guess.first), float(guess.second), guessed_cost};
        constexpr int kMostSteps = 3;
        for (int step = 0; step < kMostSteps; ++step) {
            const int from_x = int(best.x), from_y = int(best.y);
            for (int dy = from_y - 1; dy <= from_y + 1; ++dy)
                for (int dx = from_x - 1; dx <= from_x + 1; ++dx) {
                    if (dx == from_x && dy == from_y) continue;
                    const float away = std::hypot(float(dx - guess.first), float(dy - guess.second));
                    const float c = cost(window, dx, dy) + kStiffness * away;
                    if (c < best.cost) best = {float(dx), float(dy), c};
                }
            if (int(best.x) == from_x && int(best.y) == from_y) break;
        }
        return best;
    }

    // Parts of a cell, by the parabola through the costs of the neighbours.
    void refine(int x, int y, Match& match) const {
        const Window window = this->window(x, y);
        const int dx = int(match.x), dy = int(match.y);
        const auto part = [middle = cost(window, dx, dy)](float before, float after) {
            const float bend = before + after - 2 * middle;
            return bend > 1e-6f ? std::clamp(0.5f * (before - after) / bend, -0.5f, 0.5f) : 0.0f;
        };
        match.x += part(cost(window, dx - 1, dy), cost(window, dx + 1, dy));
        match.y += part(cost(window, dx, dy - 1), cost(window, dx, dy + 1));
        const View<const float> stops = from_.stops;
        match.texture = std::abs(stops.clamped(x + 1, y) - stops.clamped(x - 1, y)) +
                        std::abs(stops.clamped(x, y + 1) - stops.clamped(x, y - 1));
    }

private:
    float cost_of_cell(float depth, float stops, int u, int v) const {
        if (!to_.stops.rect().contains(u, v)) return 1;
        const float there = to_.depth(u, v);
        if (std::isinf(depth) != std::isinf(there)) return 1;
        const float ratio = std::isinf(depth) ? 1 : std::max(depth, there) / std::min(depth, there);
        if (!(ratio < kSilhouette)) return 1;
        return std::min(1.0f, std::abs(stops - to_.stops(u, v)) + 0.5f * (ratio - 1) / (kSilhouette - 1));
    }

    const Level &from_, &to_;
};

// The cheapest of all motions within the search.
Match searched(const Matching& matching, int x, int y, const PixelMove& shift) {
    Match best{0, 0, std::numeric_limits<float>::max()};
    const Matching::Window window = matching.window(x, y);
    const int middle_x = int(std::lround(shift.x)), middle_y = int(std::lround(shift.y));
    for (int dy = middle_y - kSearch; dy <= middle_y + kSearch; ++dy)
        for (int dx = middle_x - kSearch; dx <= middle_x + kSearch; ++dx) {
            const float away = std::hypot(float(dx - middle_x), float(dy - middle_y));
            const float c = matching.cost(window, dx, dy) + kStiffness * away;
            if (c < best.cost) best = {float(dx), float(dy), c};
        }
    return best;
}

// The cheapest motion of the cells around cx, cy of the coarser level, improved.
Match followed(const Matching& matching, const Image<Match>& coarse, int cx, int cy, int x, int y) {
    const Matching::Window window = matching.window(x, y);
    std::pair<int, int> guess{};
    float least = std::numeric_limits<float>::max();
    const View<const Match> found = coarse;
    for (const auto& [dx, dy] : {std::pair{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        const Match& m = found.clamped(cx + dx, cy + dy);
        const std::pair<int, int> move{int(2 * m.x), int(2 * m.y)};
        if (least < std::numeric_limits<float>::max() && move == guess) continue;
        const float c = matching.cost(window, move.first, move.second);
        if (c >= least) continue;
        least = c;
        guess = move;
    }
    return matching.improved(window, guess, least);
}

// Motion of one node out of two by two cells, cells of the data.
Image<Match> matches(const std::vector<Level>& from, const std::vector<Level>& to, int data,
                     const PixelMove& shift, Workers& workers) {
    Image<Match> found;
    for (int level = int(from.size()) - 1; level > data; --level) {
        const Level& own = from[std::size_t(level)];
        const Matching matching(own, to[std::size_t(level)]);
        const bool first = level + 1 == int(from.size());
        const float share = 1 / float(1 << level);
        Image<Match> better(own.stops.width(), own.stops.height());
        for_rows(better.height(), workers, [&](int y) {
            for (int x = 0; x < better.width(); ++x)
                better(x, y) = first ? searched(matching, x, y, {share * shift.x, share * shift.y})
                                     : followed(matching, found, x / 2, y / 2, x, y);
        });
        found = std::move(better);
    }
    const Matching matching(from[std::size_t(data)], to[std::size_t(data)]);
    Image<Match> nodes(found.width(), found.height());
    for_rows(nodes.height(), workers, [&](int y) {
        for (int x = 0; x < nodes.width(); ++x) {
            nodes(x, y) = followed(matching, found, x, y, 2 * x, 2 * y);
            matching.refine(2 * x, 2 * y, nodes(x, y));
        }
    });
    return nodes;
}

// Weighted sums of motion.
struct Sums {
    float weight = 0, x = 0, y = 0;
    Sums& operator+=(const Sums& b) { return *this = {weight + b.weight, x + b.x, y + b.y}; }
};
Sums operator*(float share, const Sums& s) { return {share * s.weight, share * s.x, share * s.y}; }

// Carries sums along n nodes, both ways, as far as their surface continues.
template <typename At, typename Depth>
void carry(int n, const At& at, const Depth& depth) {
    std::vector<Sums> onward(static_cast<std::size_t>(n));
    Sums held;
    for (int i = 0; i < n; ++i) {
        held = i > 0 && one_surface(depth(i - 1), depth(i)) ? kKept * held : Sums{};
        onward[std::size_t(i)] = held;
        held += at(i);
    }
    held = {};
    for (int i = n - 1; i >= 0; --i) {
        held = i + 1 < n && one_surface(depth(i + 1), depth(i)) ? kKept * held : Sums{};
        const Sums own = at(i);
        at(i) += onward[std::size_t(i)];
        at(i) += held;
        held += own;
    }
}

// True if the way back from where a node lands leads to it: what the other picture hides lands anywhere.
bool comes_back(const Match& match, int x, int y, const Image<Match>& back) {
    constexpr float kNear = 1.5f;  // cells of the data
    const int u = int(std::lround(float(x) + match.x / 2)), v = int(std::lround(float(y) + match.y / 2));
    return back.rect().contains(u, v) && std::hypot(match.x + back(u, v).x, match.y + back(u, v).y) < kNear;
}

// Motion smoothed along surfaces: textured nodes that match both ways count most.
Image<Sums> smoothed(const Image<Match>& nodes, const Image<Match>& back, const Level& level) {
    constexpr float kWellMatched = 0.15f, kPlain = 0.02f, kAstray = 1e-4f;
    Image<Sums> sums(nodes.width(), nodes.height());
    for (int y = 0; y < nodes.height(); ++y)
        for (int x = 0; x < nodes.width(); ++x) {
            const Match& m = nodes(x, y);
            const float off = m.cost / kWellMatched, squared = off * off;
            const float weight = (comes_back(m, x, y, back) ? 1 : kAstray) * (m.texture + kPlain) /
                                 (1 + squared * squared * squared);
            sums(x, y) = {weight, weight * m.x, weight * m.y};
        }
    const auto depth = [&](int x, int y) { return level.depth(2 * x, 2 * y); };
    constexpr int kTimes = 2;
    for (int time = 0; time < kTimes; ++time) {
        for (int y = 0; y < sums.height(); ++y)
            carry(
                sums.width(), [&](int x) -> Sums& { return sums(x, y); }, [&](int x) { return depth(x, y); });
        for (int x = 0; x < sums.width(); ++x)
            carry(
                sums.height(), [&](int y) -> Sums& { return sums(x, y); },
                [&](int y) { return depth(x, y); });
    }
    return sums;
}

// The motion of a pixel by the nodes around it that lie on its surface.
PixelMove at_pixel(const Image<Sums>& sums, const Level& nodes, int x, int y, float depth, int node_px) {
    const float px = (float(x) + 0.5f) / float(node_px) - 0.25f,
                py = (float(y) + 0.5f) / float(node_px) - 0.25f;
    const int u = int(std::floor(px)), v = int(std::floor(py));
    Sums sum;
    for (int j = v - 1; j <= v + 2; ++j)
        for (int i = u - 1; i <= u + 2; ++i) {
            if (!sums.rect().contains(i, j) || !(sums(i, j).weight > 0)) continue;
            if (!one_surface(depth, nodes.depth(2 * i, 2 * j))) continue;
            const float near =
                std::max(0.0f, 2 - std::abs(px - float(i))) * std::max(0.0f, 2 - std::abs(py - float(j)));
            sum += (near / sums(i, j).weight) * sums(i, j);
        }
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    if (!(sum.weight > 0)) return {kUnknown, kUnknown};
    const float scale = float(node_px) / 2 / sum.weight;
    return {scale * sum.x, scale * sum.y};
}

}  // namespace

Image<PixelMove> optical_flow(const DepthPicture& from, const DepthPicture& to, Workers& workers) {
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    constexpr std::size_t kLargePx = 400'000;
    Image<PixelMove> moves(from.colour.width(), from.colour.height(), PixelMove{kUnknown, kUnknown});
    std::vector<Level> a = pyramid(from, workers), b = pyramid(to, workers);
    if (a.size() > b.size()) a.resize(b.size());
    if (b.size() > a.size()) b.resize(a.size());
    if (a.size() < 3) return moves;
    const int data = moves.size() > kLargePx ? 1 : 0, node_px = 2 << data;
    const PixelMove shift{float(from.window.x0 - to.window.x0), float(from.window.y0 - to.window.y0)};
    const Image<Sums> sums =
        smoothed(matches(a, b, data, shift, workers), matches(b, a, data, {-shift.x, -shift.y}, workers),
                 a[std::size_t(data)]);
    for_rows(moves.height(), workers, [&](int y) {
        for (int x = 0; x < moves.width(); ++x) {
            PixelMove& move = moves(x, y);
            move = at_pixel(sums, a[std::size_t(data)], x, y, from.depth(x, y), node_px);
            move.x -= shift.x, move.y -= shift.y;
        }
    });
    return moves;
}

}  // namespace petzval::shot
