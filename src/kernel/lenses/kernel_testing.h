// Measures of kernels for tests: sums, moments, radial profiles, differences.
#pragma once

#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::kernel {

inline Mount full_frame(double f_number = 2, int width_px = 1920) {
    return {.camera = {50, 36, f_number, 2},
            .display_width_px = width_px,
            .display_height_px = width_px * 9 / 16};
}

inline std::unique_ptr<const LensModel> lens_of(const LensChoice& choice, const Mount& mount = full_frame()) {
    return std::move(make_lens(choice, mount)).value();
}

inline std::unique_ptr<const LensModel> lens_named(const std::string& name, double f_number = 2) {
    LensChoice choice;
    choice.name = name;
    return lens_of(choice, full_frame(f_number));
}

inline Rgba weight_at(const PointSpread& s, int dx, int dy) {
    return s.extent.contains(dx, dy) ? s.weights(dx - s.extent.x0, dy - s.extent.y0) : Rgba{};
}

struct Sums {
    double r = 0, g = 0, b = 0, a = 0, least = 0;  // least: the most negative weight
};
inline Sums sums(const PointSpread& s) {
    Sums t;
    for (std::size_t i = 0; i < s.weights.size(); ++i) {
        const Rgba w = s.weights.pixels()[i];
        t.r += double(w.r), t.g += double(w.g), t.b += double(w.b), t.a += double(w.a);
        t.least = std::min({t.least, double(w.r), double(w.g), double(w.b), double(w.a)});
    }
    return t;
}

// Moments of the luminance: centre and mean squares about the source, all light of a pixel counted at its
// centre.
struct Moments {
    double x = 0, y = 0, xx = 0, yy = 0;
};
inline Moments moments(const PointSpread& s) {
    Moments m;
    for (int y = s.extent.y0; y < s.extent.y1; ++y)
        for (int x = s.extent.x0; x < s.extent.x1; ++x) {
            const double w = double(weight_at(s, x, y).a);
            m.x += w * x, m.y += w * y, m.xx += w * x * x, m.yy += w * y * y;
        }
    return m;
}

// Largest difference of any channel over all pixels of two kernels.
inline double largest_difference(const PointSpread& p, const PointSpread& q) {
    const Rect a = p.extent, b = q.extent;
    double most = 0;
    for (int y = std::min(a.y0, b.y0); y < std::max(a.y1, b.y1); ++y)
        for (int x = std::min(a.x0, b.x0); x < std::max(a.x1, b.x1); ++x) {
            const Rgba d = weight_at(p, x, y) - weight_at(q, x, y);
            most = std::max({most, std::abs(double(d.r)), std::abs(double(d.g)), std::abs(double(d.b))});
        }
    return most;
}

inline double brightest(const PointSpread& s) {
    float most = 0;
    for (std::size_t i = 0; i < s.weights.size(); ++i) most = std::max(most, s.weights.pixels()[i].a);
    return double(most);
}

// Weights times the area of a disc of radius |coc|, along +x: 1 everywhere inside for a flat disc.
inline std::vector<Rgba> radial_profile(const PointSpread& s, double coc_radius_px) {
    const float area = float(3.14159265 * coc_radius_px * coc_radius_px);
    std::vector<Rgba> profile;
    for (int x = 0; x < s.extent.x1; ++x) profile.push_back(area * weight_at(s, x, 0));
    return profile;
}

}  // namespace petzval::kernel
