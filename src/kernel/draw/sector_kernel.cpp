#include "kernel/draw/sector_kernel.h"

#include "base/cancel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace petzval::kernel {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Squared distance of the outline from the axis, averaged over each of `count` even directions: the share of
// the direction's rays that the outline lets through.
std::vector<double> open_areas(const std::vector<Point>& outline, int count) {
    // Twice the area swept by the outline up to each direction, by walking its edges; edges are cut at
    // directions.
    std::vector<double> area(std::size_t(count), 0.0);
    const double step = kTurn / count;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        Point from = outline[i];
        const Point to = outline[(i + 1) % outline.size()];
        double angle = std::atan2(from.y, from.x);
        if (angle < 0) angle += kTurn;
        double end = angle + std::atan2(cross(from, to), from.x * to.x + from.y * to.y);
        for (int k = int(angle / step); angle < end; ++k) {
            const double border = std::min(end, step * (k + 1));
            Point at = to;
            if (border < end) {
                const Point along{std::cos(border), std::sin(border)};
                const double t = cross(from, along) / (cross(from, along) - cross(to, along));
                at = from + t * (to - from);
            }
            area[std::size_t(k % count)] += cross(from, at) / step;
            from = at, angle = border;
        }
    }
    for (double& a : area) a = std::clamp(a, 0.0, 1.0);
    return area;
}

using Sample = RingSweep::Sample;

// Even steps of signed radius.
struct RadiusGrid {
    double low = 0, step = 0;
    int count = 0;

    RadiusGrid(const std::vector<RingBand>& bands, double reach_px) {
        step = reach_px < 12 ? 0.125 : std::max(0.25, reach_px / 2048);
        double high = 0;
        constexpr std::size_t kProbes = 256;
        std::array<double, kProbes + 1> areas, landed;
        for (std::size_t i = 0; i <= kProbes; ++i) areas[i] = double(i) / kProbes;
        for (const RingBand& band : bands) {
            band.landings_px(areas, landed.data());
            for (const double v : landed) low = std::min(low, v), high = std::max(high, v);
        }
        // 0 is a border between bins; a pixel's half width is left free at both ends.
        const int below = int(std::ceil((0.6 - low) / step)), above = int(std::ceil((high + 0.6) / step));
        low = -below * step, count = below + above;
    }
    // Area per turn of a bin's ring.
    double ring_area(int i) const {
        const double inner = low + step * i, outer = inner + step;
        return 0.5 * std::abs(outer * outer - inner * inner) * kTurn;
    }
};

// Light of one zone of the pupil in all bands, per turn, on the bins that it touches.
class Zone {
public:
    explicit Zone(const RadiusGrid& grid)
        : grid_(grid), light_(std::size_t(grid.count)), first_(grid.count) {}

    // Even over the area between signed radii a and b.
    void add(double a, double b, const Light& light) {
        if (a > b) std::swap(a, b);
        if (a < 0 && b > 0) {
            add_one_sided(a, 0, (-a / (b - a)) * light);
            add_one_sided(0, b, (b / (b - a)) * light);
        } else {
            add_one_sided(a, b, light);
        }
    }
    // Adds `share` of the zone to a profile of light per area.
    void add_to(std::vector<Sample>& profile, double share) const {
        for (int i = first_; i <= last_; ++i) {
            const Light l = (share / grid_.ring_area(i)) * light_[std::size_t(i)];
            profile[std::size_t(i)] = profile[std::size_t(i)] + Sample{float(l.r), float(l.g), float(l.b), 0};
        }
    }
    void clear() {
        for (int i = first_; i <= last_; ++i) light_[std::size_t(i)] = {};
        first_ = grid_.count, last_ = -1;
    }

private:
    void add_one_sided(double a, double b, const Light& light) {
        const int first = std::clamp(int((a - grid_.low) / grid_.step), 0, grid_.count - 1);
        const int last = std::clamp(int((b - grid_.low) / grid_.step), first, grid_.count - 1);
        first_ = std::min(first_, first), last_ = std::max(last_, last);
        const double whole = b * b - a * a;
        if (first == last || whole == 0) {
            light_[std::size_t(first)] += light;
            return;
        }
        double from = a;
        for (int i = first; i <= last; ++i) {
            const double to = i == last ? b : grid_.low + grid_.step * (i + 1);
            light_[std::size_t(i)] += ((to * to - from * from) / whole) * light;
            from = to;
        }
    }

    const RadiusGrid& grid_;
    std::vector<Light> light_;
    int first_, last_ = -1;
};

// Open part of the pupil in each of many even directions.
class Directions {
public:
    Directions(const std::vector<Point>& outline, const RingSweep& sweep)
        : sweep_(sweep), count_(std::bit_ceil(unsigned(std::clamp(8 * sweep.reach_px(), 128.0, 1024.0)))) {
        // Whole zones, and the share of the next one's area.
        const double zones = sweep.zones();
        for (const double open : open_areas(outline, int(count_))) {
            const double whole = std::floor(std::sqrt(open) * zones);
            zones_open_.push_back(
                whole + std::clamp((open * zones * zones - whole * whole) / (2 * whole + 1), 0.0, 1 - 1e-12));
        }
    }

    // The direction at an angle of -pi…2 pi.
    unsigned at(double angle) const { return unsigned((angle + kTurn) * (count_ / kTurn)) & (count_ - 1); }
    bool same(unsigned p, unsigned q) const { return zones_open_[p] == zones_open_[q]; }

    // Mean along the radius, from `inner` to `outer`, of light from both sides of the axis.
    Sample mean(double inner, double outer, unsigned direction) const {
        const double here = zones_open_[direction];
        Sample sum = sweep_.integral(here, outer) - sweep_.integral(here, inner);
        if (-inner > sweep_.lowest_px()) {
            const double opposite = zones_open_[(direction + count_ / 2) & (count_ - 1)];
            sum = sum + sweep_.integral(opposite, -inner) - sweep_.integral(opposite, -outer);
        }
        return float(1 / (outer - inner)) * sum;
    }
    double largest_radius() const { return sweep_.largest_px(); }

private:
    const RingSweep& sweep_;
    unsigned count_;  // a power of two
    std::vector<double> zones_open_;
};

double length(double x, double y) { return std::sqrt(x * x + y * y); }  // std::hypot minds overflow, and time

// The share of the pixel at (x, y). Away from the axis its square is a box along the radius and three lines
// across; near the axis, where directions crowd, it is cut up.
Sample pixel_share(const Directions& directions, double x, double y, double vertical_scale) {
    const double tall = 1 / vertical_scale;
    const double radius = length(x, y * tall);
    if (radius > 4) {
        const double cos = x / radius, sin = y * tall / radius;
        const double along = 0.5 * length(cos, sin * tall), inner = radius - along, outer = radius + along;
        if (inner > directions.largest_radius()) return {};
        const double angle = std::atan2(sin, cos);
        const unsigned middle = directions.at(angle);
        // Lines evenly across the pixel; near the axis, cuts run along them and more are needed.
        const int lines = radius < 24 ? 5 : 3;
        const double apart = length(sin, cos * tall) / (lines * radius);
        const Sample mean = directions.mean(inner, outer, middle);
        const int beside = lines / 2;  // on either side
        const unsigned first = directions.at(angle - beside * apart),
                       last = directions.at(angle + beside * apart);
        if (directions.same(first, middle) && directions.same(middle, last)) return mean;
        Sample sum = mean;
        for (int i = 1; i <= beside; ++i)
            sum = sum + directions.mean(inner, outer, directions.at(angle - i * apart)) +
                  directions.mean(inner, outer, directions.at(angle + i * apart));
        return float(1.0 / lines) * sum;
    }
    const int cuts = radius < 1.5 ? 8 : 6;
    Sample sum;
    for (int j = 0; j < cuts; ++j)
        for (int i = 0; i < cuts; ++i) {
            const double u = x - 0.5 + (i + 0.5) / cuts, v = (y - 0.5 + (j + 0.5) / cuts) * tall;
            const double r = length(u, v);
            sum = sum + directions.mean(std::max(0.0, r - 0.5 / cuts), r + 0.5 / cuts,
                                        directions.at(std::atan2(v, u)));
        }
    return float(1.0 / (cuts * cuts)) * sum;
}

}  // namespace

RingSweep::RingSweep(const std::vector<RingBand>& bands, double reach_px) : reach_px_(reach_px) {
    const RadiusGrid grid(bands, reach_px);
    low_ = grid.low, step_ = grid.step, per_step_ = 1 / grid.step, bins_ = grid.count;
    zones_ = int(std::clamp(3 * reach_px, 48.0, 768.0));
    std::vector<Sample> arrived(std::size_t(bins_), Sample{});
    std::vector<double> from(bands.size()), to(bands.size());
    const auto land = [&](double area, std::vector<double>& landed) {
        for (std::size_t b = 0; b < bands.size(); ++b) bands[b].landings_px({&area, 1}, &landed[b]);
    };
    land(0, from);
    Zone zone(grid);
    integrals_.assign(std::size_t(bins_) + 1, Sample{});
    integrals_.reserve((std::size_t(bins_) + 1) * (std::size_t(zones_) + 1));
    for (int i = 1; i <= zones_; ++i) {  // evenly wide
        const double inner = (i - 1.0) * (i - 1.0) / (double(zones_) * zones_);
        const double outer = double(i) * i / (double(zones_) * zones_);
        check_cancelled();
        zone.clear();
        land(outer, to);
        for (std::size_t b = 0; b < bands.size(); ++b)
            zone.add(from[b], to[b], (outer - inner) * bands[b].weight);
        from.swap(to);
        zone.add_to(arrived, 1);
        Sample sum;
        integrals_.push_back(sum);
        for (const Sample& d : arrived) integrals_.push_back(sum = sum + float(step_) * d);
    }
}

double RingSweep::largest_px() const { return std::max(-low_, low_ + step_ * bins_); }

PointSpread sector_kernel(const std::vector<Point>& outline, const RingSweep& sweep, double vertical_scale) {
    const double reach_px = sweep.reach_px();
    const int wide = int(std::ceil(reach_px - 0.5)), tall = int(std::ceil(reach_px * vertical_scale - 0.5));
    if (wide <= 0 && tall <= 0) return single_pixel();
    const Directions directions(outline, sweep);
    PointSpread spread{{-wide, -tall, wide + 1, tall + 1}, Image<Rgba>(2 * wide + 1, 2 * tall + 1), false};
    for (int y = -tall; y <= tall; ++y) {
        check_cancelled();
        for (int x = -wide; x <= wide; ++x) {
            const Sample share = pixel_share(directions, x, y, vertical_scale);
            spread.weights(x + wide, y + tall) = {share.r, share.g, share.b, 0};
        }
    }
    trim(spread);
    normalise(spread);
    return spread;
}

bool is_star_about_axis(const std::vector<Point>& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (cross(outline[i], outline[(i + 1) % outline.size()]) < -1e-9) return false;
    return true;
}

}  // namespace petzval::kernel
