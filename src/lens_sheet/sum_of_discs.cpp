// A picture out of focus is what its points became, laid over one another.
#include "base/parallel.h"
#include "lens_sheet/figures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::lens_sheet {
namespace {

constexpr int kWide = 384, kHigh = 288;  // px of a panel
constexpr double kDiscPx = 15;           // radius of the circle of confusion
constexpr double kBlurs = 6;             // the same in the lens's own blurs

struct LitPoint {
    int x, y;
    Rgba light;
};

// Nine lamps on a cable.
std::vector<LitPoint> lamps() {
    constexpr Rgba kColours[] = {{24, 17, 9, 0}, {24, 5, 3, 0}, {6, 20, 8, 0}, {6, 12, 26, 0}};
    std::vector<LitPoint> points;
    for (int i = 0; i < 9; ++i) {
        const double t = i / 8.0;
        points.push_back({int(34 + 316 * t), int(150 + 90 * 4 * t * (1 - t)), 7 * kColours[i % 4]});
    }
    return points;
}

// A crescent, pixel by pixel, in an order that a part of it covers evenly.
std::vector<LitPoint> moon() {
    std::vector<LitPoint> points;
    for (int y = 0; y < kHigh; ++y)
        for (int x = 0; x < kWide; ++x)
            if (std::hypot(x - 290, y - 74) < 38 && std::hypot(x - 309, y - 62) > 34)
                points.push_back({x, y, {1.3f, 1.15f, 0.8f, 0}});
    const std::size_t count = points.size();
    std::vector<LitPoint> mixed;
    for (std::size_t i = 0; i < count; ++i) mixed.push_back(points[i * 619 % count]);  // 619 is prime
    return mixed;
}

void add(Canvas& canvas, const LitPoint& point, const kernel::PointSpread& disc, float times) {
    const Rect& e = disc.extent;
    for (int v = e.y0; v < e.y1; ++v)
        for (int u = e.x0; u < e.x1; ++u)
            if (canvas.light().rect().contains(point.x + u, point.y + v))
                canvas.light()(point.x + u, point.y + v) +=
                    times * (point.light * disc.weights(u - e.x0, v - e.y0));
}

// A panel with that share of the moon, brightened so that all panels have the same light.
std::string panel(const kernel::PointSpread& disc, double share) {
    Canvas canvas(kWide, kHigh);
    for (const LitPoint& lamp : lamps()) add(canvas, lamp, disc, 1);
    const std::vector<LitPoint> all = moon();
    const std::size_t taken = std::max<std::size_t>(1, std::size_t(share * double(all.size())));
    for (std::size_t i = 0; i < taken; ++i) add(canvas, all[i], disc, float(all.size()) / float(taken));
    return canvas.uri();
}

// Large enough to be seen.
kernel::PointSpread in_focus() {
    kernel::PointSpread point;
    point.extent = {-1, -1, 2, 2};
    point.weights = Picture(3, 3, {1.0f / 9, 1.0f / 9, 1.0f / 9, 0});
    return point;
}

}  // namespace

std::optional<Figure> sum_of_discs(const Subject& subject) {
    LensChoice five;
    five.aperture.blades = 5, five.aperture.rotation_deg = 90;
    const double um_per_px = kBlurs * subject.blur_um() / kDiscPx;
    const auto lens = subject.mounted(subject.f_number(), five, um_per_px);
    if (!lens || !*lens) return std::nullopt;
    const kernel::PointSpread disc = (*lens)->point_spread(kDiscPx, {});
    constexpr double kWidth = 1100, kGap = 10, kTop = 24, kCell = (kWidth - 3 * kGap) / 4;
    struct Panel {
        const char* words;
        double share;
        bool sharp;
    };
    constexpr std::array<Panel, 4> kPanels{{{"in focus", 1, true},
                                            {"lamps, 1 of 60 points of the moon", 1.0 / 60, false},
                                            {"1 of 8", 1.0 / 8, false},
                                            {"all points: the picture", 1, false}}};
    const kernel::PointSpread point = in_focus();
    std::array<std::string, kPanels.size()> pictures;
    parallel_for(int(kPanels.size()), subject.workers(), [&](int i) {
        const Panel& p = kPanels[std::size_t(i)];
        pictures[std::size_t(i)] = panel(p.sharp ? point : disc, p.share);
    });
    const double high = kCell * kHigh / kWide;
    Svg svg(kWidth, kTop + high + 2, "a picture as the sum of the aperture's shape, once for each point");
    for (std::size_t i = 0; i < kPanels.size(); ++i) {
        const double x = double(i) * (kCell + kGap);
        svg.text({x, 14}, kPanels[i].words, "title");
        svg.image({x, kTop}, kCell, high, pictures[i]);
    }
    return Figure{svg.str(),
                  "A picture out of focus is a sum of aperture shapes, one for each point. This aperture has "
                  "five blades, and the picture is behind focus. Lamps show the shape; evenly lit surfaces "
                  "show it only in their soft edges.",
                  12};
}

}  // namespace petzval::lens_sheet
