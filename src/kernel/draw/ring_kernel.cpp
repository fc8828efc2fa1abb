#include "kernel/draw/ring_kernel.h"

#include "base/cancel.h"
#include "kernel/model/gamut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace petzval::kernel {
namespace {

using Rgb = std::array<double, 3>;

// Energy of rings on a fine grid of radii, for one wavelength. Radii are in bins here.
class RingGrid {
public:
    explicit RingGrid(std::size_t bins) : energy_(bins, 0.0), density_step_(bins, 0.0) {}

    // `energy` spread evenly over the area between radii a and b; either may be negative: the ring then
    // passes through the axis.
    void add_annulus(double a, double b, double energy) {
        if (a * b < 0) {
            // Zones so thin that their radius runs straight: energy falls to both sides of the axis in
            // proportion.
            const double share = std::abs(a) / (std::abs(a) + std::abs(b));
            add_ordered(0, std::abs(a), energy * share);
            add_ordered(0, std::abs(b), energy * (1 - share));
        } else {
            add_ordered(std::min(std::abs(a), std::abs(b)), std::max(std::abs(a), std::abs(b)), energy);
        }
    }
    // Adds each bin's energy times `weight`.
    void add_to(std::vector<Light>& total, Light weight) const {
        double density = 0;
        for (std::size_t i = 0; i < energy_.size(); ++i) {
            density += density_step_[i];
            total[i] += (energy_[i] + std::max(density, 0.0) * double(2 * i + 1)) * weight;
        }
    }

private:
    // Bins that are covered in part get their share; those between them, a density that begins and ends.
    void add_ordered(double a, double b, double energy) {
        const std::size_t top = energy_.size() - 1;
        const std::size_t first = std::min(top, std::size_t(a)), last = std::min(top, std::size_t(b));
        if (first == last) {
            energy_[first] += energy;
            return;
        }
        const double per_area = energy / (b * b - a * a);
        const double behind_first = double(first + 1), before_last = double(last);
        energy_[first] += per_area * (behind_first * behind_first - a * a);
        energy_[last] += per_area * (b * b - before_last * before_last);
        density_step_[first + 1] += per_area;
        density_step_[last] -= per_area;
    }

    std::vector<double> energy_, density_step_;  // of a bin, and per area (in bins squared) from it on
};

// Light per area against radius, constant within a bin, with its first and second integrals: what a square
// sees of it is a second difference.
class RadialProfile {
public:
    RadialProfile(const std::vector<Light>& energy, double step) : step_(step), nodes_(energy.size() + 1) {
        for (std::size_t i = 0; i < energy.size(); ++i) {
            const double ring_area = std::numbers::pi * step * step * double(2 * i + 1);
            const Rgb light{energy[i].r, energy[i].g, energy[i].b};
            for (std::size_t c = 0; c < 3; ++c) {
                nodes_[i].density[c] = light[c] / ring_area;
                nodes_[i + 1].first[c] = nodes_[i].first[c] + nodes_[i].density[c] * step;
                nodes_[i + 1].second[c] =
                    nodes_[i].second[c] + step * (nodes_[i].first[c] + 0.5 * nodes_[i].density[c] * step);
            }
        }
    }

    // Mean over a square of side `side` centred at (x, y), not over the axis. Circles count as straight lines
    // across the square, whose projection on the radius is a trapezoid: the product of two boxes.
    Rgb mean_over_square(double x, double y, double side) const {
        const double to_centre = std::hypot(x, y);
        // The mean radius of a square is a little more than the radius of its middle.
        const double r = to_centre + side * side / (24 * to_centre);
        constexpr double kNarrowest = 1e-3;  // keeps the second difference away from 0/0
        const double p = std::max(side * std::abs(x) / to_centre, kNarrowest);
        const double q = std::max(side * std::abs(y) / to_centre, kNarrowest);
        const double outer = 0.5 * (p + q), inner = 0.5 * std::abs(p - q);
        const Rgb a = second(r + outer), b = second(r + inner), c = second(r - inner), d = second(r - outer);
        Rgb mean;
        for (std::size_t i = 0; i < 3; ++i) mean[i] = (a[i] - b[i] - c[i] + d[i]) / (p * q);
        return mean;
    }

    // Light in the square of side 1 around the axis.
    Rgb in_middle_square() const {
        Rgb sum{};
        for (std::size_t i = 0; i + 1 < nodes_.size() && step_ * double(i) < std::numbers::sqrt2 / 2; ++i) {
            const double part = disc_in_square(step_ * double(i + 1)) - disc_in_square(step_ * double(i));
            for (std::size_t c = 0; c < 3; ++c) sum[c] += nodes_[i].density[c] * part;
        }
        return sum;
    }

private:
    // Area that a disc about the axis shares with the square of side 1: the disc less four segments.
    static double disc_in_square(double r) {
        if (r <= 0.5) return std::numbers::pi * r * r;
        if (r >= std::numbers::sqrt2 / 2) return 1;
        return std::numbers::pi * r * r - 4 * (r * r * std::acos(0.5 / r) - 0.5 * std::sqrt(r * r - 0.25));
    }

    struct Node {
        Rgb density{}, first{}, second{};
    };
    Rgb second(double r) const {
        r = std::max(r, 0.0);
        const std::size_t i = std::min(std::size_t(r / step_), nodes_.size() - 1);
        const double t = r - step_ * double(i);
        const Node& n = nodes_[i];
        Rgb value;
        for (std::size_t c = 0; c < 3; ++c)
            value[c] = n.second[c] + t * (n.first[c] + 0.5 * t * n.density[c]);
        return value;
    }

    double step_;
    std::vector<Node> nodes_;
};

// A pixel is cut into squares so small that circles leave their tangents by less than 0.004 px across one.
Rgb pixel_share(const RadialProfile& profile, int x, int y) {
    const int cuts = std::clamp(int(std::ceil(5.6 / std::sqrt(std::hypot(x, y)))), 1, 8);
    Rgb sum{};
    for (int j = 0; j < cuts; ++j)
        for (int i = 0; i < cuts; ++i) {
            const Rgb mean =
                profile.mean_over_square(x - 0.5 + (i + 0.5) / cuts, y - 0.5 + (j + 0.5) / cuts, 1.0 / cuts);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += mean[c] / (cuts * cuts);
        }
    return sum;
}

}  // namespace

std::vector<Light> ring_energy(const std::vector<RingBand>& bands, double reach_px, std::size_t bins) {
    // Zones of even area, thinner than a tenth of a pixel at the rim.
    const std::size_t zones = std::size_t(std::clamp(8 * reach_px, 128.0, 4096.0));
    std::vector<Light> total(bins);
    const double bins_per_px = double(bins) / reach_px;
    std::vector<double> areas(zones + 1), landed(zones + 1);
    for (std::size_t i = 0; i <= zones; ++i) areas[i] = double(i) / double(zones);
    for (const RingBand& band : bands) {
        check_cancelled();
        RingGrid grid(bins);
        band.landings_px(areas, landed.data());
        for (double& radius : landed) radius *= bins_per_px;
        for (std::size_t i = 0; i < zones; ++i) {
            const double light = band.light ? band.light(0.5 * (areas[i] + areas[i + 1])) : 1;
            grid.add_annulus(landed[i], landed[i + 1], light / double(zones));
        }
        grid.add_to(total, band.weight);
    }
    return total;
}

namespace {

// Pixels beyond the first that light touches.
int radius_of(double reach_px) { return int(std::ceil(reach_px - 0.5)); }

std::vector<Light> fine_rings(const std::vector<RingBand>& bands, double reach_px, RingColours colours) {
    const std::size_t bins = std::size_t(std::clamp(32 * reach_px, 64.0, 8192.0));
    std::vector<Light> rings = ring_energy(bands, reach_px, bins);
    if (colours == RingColours::InGamut) map_into_gamut(rings);
    return rings;
}

}  // namespace

std::vector<Rgba> ring_row(const std::vector<RingBand>& bands, double reach_px, RingColours colours) {
    const int radius = radius_of(reach_px);
    if (radius <= 0) return {{1, 1, 1, 0}};
    const std::vector<Light> rings = fine_rings(bands, reach_px, colours);
    const RadialProfile profile(rings, reach_px / double(rings.size()));
    Light all;
    for (const Light& ring : rings) all += ring;
    const double least = colours == RingColours::InGamut ? 0 : -std::numeric_limits<double>::infinity();
    std::vector<Rgba> row;
    for (int x = 0; x <= radius; ++x) {
        const Rgb c = x == 0 ? profile.in_middle_square() : pixel_share(profile, x, 0);
        const auto weight = [least](double light, double of) { return float(std::max(least, light / of)); };
        row.push_back({weight(c[0], all.r), weight(c[1], all.g), weight(c[2], all.b), 0});
        row.back().a = alpha_of(row.back());
    }
    return row;
}

PointSpread ring_kernel(const std::vector<RingBand>& bands, double reach_px, RingColours colours) {
    const int radius = radius_of(reach_px);
    if (radius <= 0) return single_pixel();
    const std::vector<Light> rings = fine_rings(bands, reach_px, colours);
    const RadialProfile profile(rings, reach_px / double(rings.size()));

    const int width = 2 * radius + 1;
    PointSpread spread{{-radius, -radius, radius + 1, radius + 1}, Image<Rgba>(width, width), false};
    // Second differences leave a rounding residue where there is no light.
    const double least = colours == RingColours::InGamut ? 0 : -std::numeric_limits<double>::infinity();
    const auto as_weight = [least](const Rgb& c) {
        const auto weight = [least](double v) { return float(std::max(least, v)); };
        return Rgba{weight(c[0]), weight(c[1]), weight(c[2]), 0};
    };
    spread.weights(radius, radius) = as_weight(profile.in_middle_square());
    for (int y = 0; y <= radius; ++y) {
        check_cancelled();
        for (int x = std::max(y, 1); x <= radius; ++x) {
            const Rgba weight = as_weight(pixel_share(profile, x, y));
            for (const auto& [px, py] : {std::pair{x, y}, {y, x}})
                for (const int sx : {-1, 1})
                    for (const int sy : {-1, 1}) spread.weights(radius + sx * px, radius + sy * py) = weight;
        }
    }
    normalise(spread);
    return spread;
}

}  // namespace petzval::kernel
