#include "engine/samples/outlines/cut_edges.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace petzval::engine {
namespace {

constexpr int kReach = 6;  // upper limit of edge_reach_px
constexpr int kCell = 16;  // pixels on a side

float rise(float value, float from, float to) { return std::clamp((value - from) / (to - from), 0.0f, 1.0f); }

// Light of each clean pixel, without lamps; -1 at silhouettes.
Plane clean_light(const LitPicture& picture, const Mixtures& mixtures, Workers& workers) {
    Plane light = Plane::uninitialised(picture.colour.width(), picture.colour.height());
    parallel_for(light.height(), workers, [&](int y) {
        float* const row = light.row(y);
        for (int x = 0; x < light.width(); ++x)
            row[x] = std::max(0.0f, luminance(comparable(picture.dim(x, y))));
        mixtures.for_each_in_row(y, [&](int x, const Mixture&) { row[x] = -1; });
    });
    return light;
}

class EdgeFinder {
public:
    // light: of clean_light(). Borrows both planes.
    EdgeFinder(View<const float> radii, View<const float> light, float white)
        : radii_(radii), light_(light), dark_(completion_model.edge_dark * white) {}

    // The edge of a surface at coc_px that comes to (x, y), where something nearer begins.
    std::optional<CutEdges::Edge> edge_at(int x, int y, float coc_px) const {
        const CompletionModel& model = completion_model;
        const Changes c = changes_around(x, y, coc_px);
        if (c.sum < model.edge_change) return {};
        const float coherence = std::hypot(c.xx - c.yy, 2 * c.xy) / c.sum;
        if (coherence < model.edge_coherence) return {};
        const float angle = 0.5f * std::atan2(2 * c.xy, c.xx - c.yy);
        const float nx = std::cos(angle), ny = std::sin(angle);
        // Offset from the pixel's middle to the edge.
        const float dx = -c.at_x / c.sum, dy = -c.at_y / c.sum;
        const float off = dx * nx + dy * ny;
        const float spread = (nx * nx * c.at_xx + 2 * nx * ny * c.at_xy + ny * ny * c.at_yy) / c.sum;
        if (std::abs(off) > model.end_px || spread - off * off > model.end_px * model.end_px) return {};
        float into_x = -ny, into_y = nx, along = dx * into_x + dy * into_y;
        if (along < 0) into_x = -into_x, into_y = -into_y, along = -along;
        if (along < 1 || !hidden(x, y, into_x, into_y, coc_px)) return {};
        const float strength = rise(coherence, model.edge_coherence, model.edge_coherence + 0.1f) *
                               rise(c.sum, model.edge_change, 2 * model.edge_change);
        return CutEdges::Edge{{x, y}, -off * nx, -off * ny, into_x, into_y, coc_px, strength};
    }

private:
    // Moments of how the light of a surface changes around a pixel, relative to itself: of the change (its
    // structure tensor), and of where it is, from that pixel.
    struct Changes {
        float sum = 0, xx = 0, xy = 0, yy = 0;
        float at_x = 0, at_y = 0, at_xx = 0, at_xy = 0, at_yy = 0;
    };
    Changes changes_around(int x, int y, float coc_px) const {
        const int reach = int(completion_model.edge_reach_px);
        Changes c;
        const Rect window =
            Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(radii_.rect().grown(-1));
        if (window.empty()) return c;
        const Lights lights = lights_of(window.grown(1), coc_px);
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u) {
                const float* const here =
                    &lights[std::size_t((v - window.y0 + 1) * kSide + u - window.x0 + 1)];
                const float left = here[-1], right = here[1], up = here[-kSide], down = here[kSide];
                if (std::min({left, right, up, down}) < 0) continue;
                const float dx = change(left, right), dy = change(up, down);
                const float sum = dx * dx + dy * dy, at_x = float(u - x), at_y = float(v - y);
                c.sum += sum, c.xx += dx * dx, c.xy += dx * dy, c.yy += dy * dy;
                c.at_x += sum * at_x, c.at_y += sum * at_y;
                c.at_xx += sum * at_x * at_x, c.at_xy += sum * at_x * at_y, c.at_yy += sum * at_y * at_y;
            }
        return c;
    }
    // True if a nearer surface hides the pixel two pixels further.
    bool hidden(int x, int y, float into_x, float into_y, float coc_px) const {
        const int u = x + nearest_pixel(2 * into_x), v = y + nearest_pixel(2 * into_y);
        return radii_.rect().contains(u, v) && radii_(u, v) <= coc_px - completion_model.step_px;
    }
    // Rows of kSide: light of the surface's clean pixels, -1 of others.
    static constexpr int kSide = 2 * kReach + 3;
    using Lights = std::array<float, std::size_t(kSide) * kSide>;
    Lights lights_of(const Rect& pixels, float coc_px) const {
        Lights lights;
        for (int y = pixels.y0; y < pixels.y1; ++y)
            for (int x = pixels.x0; x < pixels.x1; ++x)
                lights[std::size_t((y - pixels.y0) * kSide + x - pixels.x0)] =
                    std::abs(radii_(x, y) - coc_px) < completion_model.step_px ? light_(x, y) : -1;
        return lights;
    }
    float change(float from, float to) const { return (to - from) / (from + to + 2 * dark_); }

    View<const float> radii_, light_;
    float dark_;
};

// Keeps the strongest of several findings of one edge at a silhouette.
void keep_strongest(std::vector<CutEdges::Edge>& edges) {
    constexpr int kApartPx = 4;
    const auto key = [](const CutEdges::Edge& e) {
        return std::tuple(e.at.y / kApartPx, e.at.x / kApartPx, e.into_x > 0, e.into_y > 0,
                          std::abs(e.into_x) > std::abs(e.into_y));
    };
    std::stable_sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
        return std::tuple(key(a), -a.strength) < std::tuple(key(b), -b.strength);
    });
    edges.erase(std::unique(edges.begin(), edges.end(),
                            [&](const auto& a, const auto& b) { return key(a) == key(b); }),
                edges.end());
}

}  // namespace

CutEdges::CutEdges(const LitPicture& picture, View<const float> radii, const Mixtures& mixtures, float white,
                   float to_px, Workers& workers) {
    if (white <= 0 || mixtures.empty()) return;
    const Plane light = clean_light(picture, mixtures, workers);
    const EdgeFinder finder(radii, light, white);
    std::vector<std::vector<Edge>> rows(static_cast<std::size_t>(radii.height()));
    parallel_for(radii.height(), workers, [&](int y) {
        for (int x = 0; x < radii.width(); ++x)
            if (const Mixture* m = mixtures.at(x, y); m && !m->shows_far && std::abs(m->far_coc_px) <= to_px)
                if (const auto edge = finder.edge_at(x, y, m->far_coc_px))
                    rows[std::size_t(y)].push_back(*edge);
    });
    for (const auto& row : rows) edges_.insert(edges_.end(), row.begin(), row.end());
    keep_strongest(edges_);
    sort_into_cells(radii.width(), radii.height());
}

void CutEdges::sort_into_cells(int width, int height) {
    constexpr int kHalf = kContinuesPx / 2;
    columns_ = (width + kCell - 1) / kCell;
    const int rows = (height + kCell - 1) / kCell;
    near_.resize(std::size_t(columns_) * std::size_t(rows));
    const auto cell = [](int at, int cells) { return std::clamp(at / kCell, 0, cells - 1); };
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        const Edge& e = edges_[i];
        const int x = e.at.x + nearest_pixel(kHalf * e.into_x), y = e.at.y + nearest_pixel(kHalf * e.into_y);
        for (int v = cell(y - kHalf, rows); v <= cell(y + kHalf, rows); ++v)
            for (int u = cell(x - kHalf, columns_); u <= cell(x + kHalf, columns_); ++u)
                near_[std::size_t(v * columns_ + u)].push_back(int(i));
    }
}

namespace {

// A point in the coordinates of an edge.
struct OnEdge {
    float x, y;
    const CutEdges::Edge& edge;
    OnEdge(const CutEdges::Edge& e, CutEdges::Point p)
        : x(float(p.x - e.at.x) - e.off_x), y(float(p.y - e.at.y) - e.off_y), edge(e) {}
    float aside() const { return y * edge.into_x - x * edge.into_y; }
    float ahead() const { return x * edge.into_x + y * edge.into_y; }
};

}  // namespace

CutEdges::Around CutEdges::around(Point hidden, float within_px) const {
    Around around;
    if (edges_.empty()) return around;
    for (const int i : near_[std::size_t(hidden.y / kCell * columns_ + hidden.x / kCell)]) {
        const Edge& e = edges_[std::size_t(i)];
        const OnEdge at(e, hidden);
        const float aside = at.aside(), ahead = at.ahead();
        if (std::abs(aside) > within_px || ahead < -completion_model.end_px - within_px ||
            ahead > completion_model.continues_px + within_px)
            continue;
        around.near_.push_back({e, aside, ahead});
    }
    return around;
}

float CutEdges::Around::passes(Point shown, float coc_px) const {
    const CompletionModel& model = completion_model;
    float open = 1;
    for (const Near& near : near_) {
        const Edge& e = near.edge;
        if (std::abs(e.coc_px - coc_px) > model.apart_px()) continue;
        const OnEdge at(e, shown);
        const float a = near.aside, b = at.aside();
        if (a * b >= 0) continue;
        const float met = (near.ahead * b - at.ahead() * a) / (b - a);
        if (met < -model.end_px || met > model.continues_px) continue;
        open *= 1 - e.strength * std::min({1.0f, std::abs(a) / model.barrier_soft_px,
                                           std::abs(b) / model.barrier_soft_px});
    }
    return std::max(open, kCut);
}

}  // namespace petzval::engine
