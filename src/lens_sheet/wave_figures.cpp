// The wavefront, and the diffraction image of a point of light.
#include "petzval/develop.h"

#include "base/parallel.h"
#include "lens_sheet/figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr double kGreen_um = 0.546074;
constexpr int kSide = 131;  // of a wavefront map

struct WaveMap {
    std::string title;
    std::vector<double> waves;  // kSide x kSide, NaN outside of the pupil
    double rms = 0, peak_to_valley = 0;
    std::vector<Point> outline;  // of the pupil, in its unit disc
};

// Wavefront aberration in waves at a point of the pupil: rays are its gradient, so it is the integral of the
// rays' errors, from the middle outwards, over 2 N (Welford 1986, ch. 7). Nodes of Gauss and Legendre.
double wavefront(const std::function<Point(Point)>& landing, Point u, double f_number) {
    constexpr double kNode[] = {0.0469100770, 0.2307653449, 0.5, 0.7692346551, 0.9530899230};
    constexpr double kWeight[] = {0.1184634425, 0.2393143352, 0.2844444444, 0.2393143352, 0.1184634425};
    double sum = 0;
    for (int k = 0; k < 5; ++k) {
        const Point d = landing(kNode[k] * u);
        sum += kWeight[k] * (d.x * u.x + d.y * u.y);
    }
    return sum / (2 * f_number * kGreen_um);
}

bool inside(const std::vector<Point>& outline, Point p) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point a = outline[i], b = outline[(i + 1) % outline.size()];
        if (kernel::cross(b - a, p - a) < 0) return false;  // outlines are convex
    }
    return true;
}

// Takes out the mean and the tilt, which move the image and do not blur it; the map is nearly round, so x and
// y count as independent.
void level(WaveMap& map) {
    double n = 0, mean = 0, tilt_x = 0, tilt_y = 0, xx = 0, yy = 0, mean_x = 0, mean_y = 0;
    const auto at = [](int i) { return 2.0 * i / (kSide - 1) - 1; };
    const auto each = [&](auto body) {
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                double& w = map.waves[std::size_t(j * kSide + i)];
                if (!std::isnan(w)) body(at(i), at(j), w);
            }
    };
    each([&](double x, double y, double w) { ++n, mean += w, mean_x += x, mean_y += y; });
    if (n == 0) return;
    mean /= n, mean_x /= n, mean_y /= n;
    each([&](double x, double y, double w) {
        tilt_x += (x - mean_x) * (w - mean), xx += (x - mean_x) * (x - mean_x);
        tilt_y += (y - mean_y) * (w - mean), yy += (y - mean_y) * (y - mean_y);
    });
    double low = 1e30, high = -1e30, square = 0;
    each([&](double x, double y, double& w) {
        w -= mean + tilt_x / xx * (x - mean_x) + tilt_y / yy * (y - mean_y);
        low = std::min(low, w), high = std::max(high, w), square += w * w;
    });
    map.rms = std::sqrt(square / n), map.peak_to_valley = high - low;
}

WaveMap map_of(const kernel::GeometricLens& lens, double f_number, double field, const std::string& title,
               Workers& workers) {
    WaveMap map{title, std::vector<double>(std::size_t(kSide * kSide), std::nan("")), 0, 0, {}};
    const kernel::FieldPosition place{0, field};
    const auto outline = lens.pupil_outline(place, 1e-3);
    const auto landing = lens.landing(1000 * kGreen_um, 0, place);
    parallel_for(kSide, workers, [&](int j) {
        for (int i = 0; i < kSide; ++i) {
            const Point u{2.0 * i / (kSide - 1) - 1, 2.0 * j / (kSide - 1) - 1};
            if (inside(outline, u)) map.waves[std::size_t(j * kSide + i)] = wavefront(landing, u, f_number);
        }
    });
    level(map);
    map.outline = outline;
    return map;
}

// Blue behind, white level, orange ahead; t in -1…1.
Rgba diverging(double t) {
    const float a = float(std::min(1.0, std::abs(t)));
    const Rgba end = t < 0 ? Rgba{0.08f, 0.34f, 0.70f, 1} : Rgba{0.80f, 0.35f, 0.02f, 1};
    return (1 - a) * Rgba{0.97f, 0.96f, 0.94f, 1} + a * end;
}

std::string picture_of(const WaveMap& map, double most) {
    Picture picture(kSide, kSide);
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const double w = map.waves[std::size_t(j * kSide + i)];
            picture(i, j) = std::isnan(w) ? Rgba{0, 0, 0, 1} : diverging(w / most);
        }
    return picture_uri(picture);
}

std::string strehl(double rms) {
    const double value = std::exp(-std::pow(2 * std::numbers::pi * rms, 2));
    return value > 0.1 ? ", Strehl " + number(value, 2) : "";
}

// A map to its own scale, with its numbers below.
void draw_map(Svg& svg, const WaveMap& map, double x, double side) {
    double most = 0.02;
    for (const double w : map.waves)
        if (!std::isnan(w)) most = std::max(most, std::abs(w));
    svg.text({x, 16}, map.title, "title");
    svg.text({x + side, 16}, "scale ±" + significant(most, 2) + " λ", "tick", Anchor::End);
    svg.image({x, 24}, side, side, picture_of(map, most));
    std::vector<Point> rim;  // hides the steps of the picture's edge
    for (const Point& p : map.outline) rim.push_back({x + side / 2 * (1 + p.x), 24 + side / 2 * (1 + p.y)});
    svg.open_window({x, 24}, side, side).path(rim, "rim", true).close_window();
    svg.text({x, side + 40}, "rms " + significant(map.rms, 2) + " λ" + strehl(map.rms), "tick");
    svg.text({x, side + 55}, "peak to valley " + significant(map.peak_to_valley, 2) + " λ", "tick");
}

Figure wavefronts(const Subject& subject) {
    std::vector<WaveMap> maps;
    if (subject.prescription()) {
        for (const double field : {0.0, 0.7, 1.0}) {
            const double deg = std::atan(field * std::tan(subject.corner_deg() * std::numbers::pi / 180)) *
                               180 / std::numbers::pi;
            maps.push_back(map_of(*subject.open(), subject.f_number(), field,
                                  field == 0 ? "axis" : number(deg, 1) + "° off the axis",
                                  subject.workers()));
        }
    } else {
        for (const double stops : {0.0, 1.0, 2.0}) {
            const double n = subject.f_number() * std::pow(2, stops / 2);
            if (const auto lens = subject.mounted(n))
                maps.push_back(map_of(**lens, n, 0, "f/" + significant(n, 2), subject.workers()));
        }
    }
    constexpr double kCell = 220;
    Svg svg(3 * kCell + 76, kCell + 60, "wavefront of " + subject.name());
    for (std::size_t i = 0; i < maps.size(); ++i) draw_map(svg, maps[i], double(i) * kCell, kCell - 16);
    Picture bar(1, 64);
    for (int y = 0; y < 64; ++y) bar(0, y) = diverging(1 - 2 * (y + 0.5) / 64);
    svg.image({3 * kCell, 24}, 14, kCell - 16, picture_uri(bar));
    svg.text({3 * kCell + 18, 34}, "ahead", "tick");
    svg.text({3 * kCell + 18, kCell + 6}, "behind", "tick");
    return {svg.str(),
            "Distance by which the wavefront in the pupil is ahead of (orange) or behind (blue) a perfect "
            "sphere around the image, in waves of 546 nm, at best focus. Below a quarter of a wave peak to "
            "valley, only diffraction is visible.",
            8};
}

// One cell of the diffraction figure.
struct WaveCell {
    std::string title, scale;
    kernel::PointSpread disc;
    double gain = 1;
    double airy_px = 0;  // radius of the first dark ring; 0: not in focus
};
constexpr int kFocusPx = 97, kSmallPx = 150;  // sides of cells
// Diffraction is followed some 48 pixels from a focus (kernel/lenses/wave_lens.cpp): just a cell of these.
constexpr double kFocusStep = 8;  // pixels per wavelength x N

void even_out(WaveCell& cell) {
    cell.gain = even_gain(cell.disc);
    if (cell.airy_px == 0) return;
    float most = 0;
    for (std::size_t i = 0; i < cell.disc.weights.size(); ++i)
        most = std::max(most, cell.disc.weights.pixels()[i].g);
    cell.gain = 40 / most;  // the first ring of an Airy figure, 1.7 % of its peak, comes out grey
}

WaveCell focus_cell(const Subject& subject, double f_number, int blades) {
    const double um_per_px = kGreen_um * f_number / kFocusStep;
    LensChoice character;
    character.aperture.blades = blades;
    WaveCell cell{"f/" + significant(f_number, 2) + (blades ? ", " + std::to_string(blades) + " blades" : ""),
                  significant(kFocusPx * um_per_px, 2) + " µm across",
                  {},
                  1,
                  1.22 * kGreen_um * f_number / um_per_px};
    if (const auto lens = subject.wave_lens(f_number, um_per_px, 1, character))
        cell.disc = (*lens)->point_spread(0, {});
    return cell;
}

// A disc of the lens made small, by rays or by waves.
WaveCell small_cell(const Subject& subject, double coc_um, double scale, double um_per_px, bool wave) {
    WaveCell cell{std::string(coc_um < 0 ? "in front, " : "behind, ") + (wave ? "waves" : "rays"),
                  significant(kSmallPx * um_per_px, 2) + " µm across",
                  {},
                  1,
                  0};
    if (!wave) {
        cell.disc = subject.axis().disc(coc_um / scale, um_per_px / scale);
    } else if (const auto lens = subject.wave_lens(subject.f_number(), um_per_px, scale)) {
        cell.disc = (*lens)->point_spread(coc_um / um_per_px, {});
    }
    return cell;
}

std::string row_of(const std::vector<WaveCell>& cells, int side) {
    Canvas canvas(int(cells.size()) * side, side);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int x = int(i) * side;
        if (!cells[i].disc.extent.empty())
            canvas.add(cells[i].disc, x + side / 2, side / 2, cells[i].gain, {x + 1, 0, x + side - 1, side});
    }
    return canvas.uri();
}

Figure drawn(std::vector<WaveCell> cells, int side, const std::string& title, const std::string& caption) {
    for (WaveCell& cell : cells)
        if (!cell.disc.extent.empty()) even_out(cell);
    constexpr double kCell = 136;
    Svg svg(4 * kCell, kCell + 60, title);
    svg.text({0, 14}, title, "title").image({0, 40}, 4 * kCell, kCell, row_of(cells, side));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        svg.text({(double(i) + 0.5) * kCell, 33}, cells[i].title, "label", Anchor::Middle);
        // Pixel centres lie half a pixel right of and below their corners.
        const double middle = (std::floor(side / 2.0) + 0.5) / side * kCell;
        if (cells[i].airy_px > 0)
            svg.circle({double(i) * kCell + middle, 40 + middle}, cells[i].airy_px / side * kCell,
                       "ring-on-night");
        svg.text({(double(i) + 0.5) * kCell, kCell + 54}, cells[i].scale, "tick", Anchor::Middle);
    }
    return {svg.str(), caption, 6};
}

}  // namespace

std::vector<Figure> wave_figures(const Subject& subject) {
    constexpr double kSmallSensor_mm = 4.8;  // the 1/3-inch chip of the talk
    const double n = subject.f_number(), scale = kSmallSensor_mm / subject.sensor_width_mm();
    const double coc_um = std::clamp(3 * subject.blur_um() * scale, 8.0, 12 * n);
    const double um_per_px = subject.axis().reach_um(coc_um / scale) * scale / 52;
    std::vector<WaveCell> focus(4), small(4);
    const double stopped[] = {std::max(n, 8.0), std::max(n, 16.0), std::max(n, 22.0)};
    parallel_for(8, subject.workers(), [&](int i) {
        if (i < 3) focus[std::size_t(i)] = focus_cell(subject, stopped[i], 0);
        if (i == 3) focus[3] = focus_cell(subject, stopped[1], 6);
        if (i > 3)
            small[std::size_t(i - 4)] =
                small_cell(subject, i < 6 ? -coc_um : coc_um, scale, um_per_px, i % 2 == 1);
    });
    return {wavefronts(subject),
            drawn(std::move(focus), kFocusPx, "In focus, stopped down",
                  "Diffraction dominates: the pattern grows with the f-number, and its first dark ring is at "
                  "1.22 λN (dashed, for 546 nm). Straight edges of the iris make spikes. Bright parts are "
                  "darkened so that rings are visible."),
            drawn(std::move(small), kSmallPx, "A small sensor, 4.8 mm wide, lens wide open",
                  "The same design made " + significant(1 / scale, 2) +
                      " times smaller, as in a compact camera. The wavelength stays the same, so discs of ±" +
                      significant(coc_um, 2) +
                      " µm have rings that rays cannot show. <code>--wave</code> draws them.")};
}

}  // namespace petzval::lens_sheet
