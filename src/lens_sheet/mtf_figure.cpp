// Contrast against fineness of detail: the modulation transfer function in white light.
//
// Rays give the line spread at best focus; its Fourier transform, times that of a perfect lens of the same
// f-number (Goodman, Introduction to Fourier Optics, ch. 6), is the geometric approximation of the MTF: close
// where aberrations are larger than a wave or much smaller, low by a few percent between (Smith, Modern
// Optical Engineering, ch. 11).
#include "base/parallel.h"
#include "colour/spectrum.h"
#include "kernel/draw/pupil.h"
#include "lens_sheet/figures.h"
#include "lens_sheet/plot.h"

#include <array>
#include <cmath>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr int kRays = 1500, kWavelengths = 9, kSteps = 40;
constexpr double kTwoPi = 2 * std::numbers::pi;

struct Mtf {
    std::vector<Point> tangential, sagittal;  // (line pairs per mm, contrast)
};

// MTF of a perfect lens with a round aperture; `share` of its highest frequency.
double diffraction_limit(double share) {
    if (share >= 1) return 0;
    return 2 / std::numbers::pi * (std::acos(share) - share * std::sqrt(1 - share * share));
}

struct Landing {
    double along_um = 0, across_um = 0, weight = 0;
};

// Light of the whole spectrum, weighted as the eye sees it.
std::vector<Landing> landings(const kernel::GeometricLens& lens, double field) {
    const kernel::FieldPosition place{0, field};
    const auto points = kernel::spread_evenly(lens.pupil_outline(place, 1e-3), kRays, 1);
    std::vector<Landing> all;
    for (const colour::SpectralBand& band : colour::spectral_bands(kWavelengths)) {
        const auto landing = lens.landing(band.wavelength_nm, 0, place);
        for (const kernel::PupilPoint& p : points) {
            const Point at = landing(p.place);
            all.push_back({at.y, at.x, band.luminance / kRays});
        }
    }
    return all;
}

double contrast(const std::vector<Landing>& light, double Landing::*which, double per_um) {
    double re = 0, im = 0;
    for (const Landing& l : light) {
        const double phase = kTwoPi * per_um * l.*which;
        re += l.weight * std::cos(phase), im += l.weight * std::sin(phase);
    }
    return std::hypot(re, im);
}

Mtf mtf_of(const kernel::GeometricLens& lens, double f_number, double field, double most_lp_mm) {
    constexpr double kGreen_mm = 0.000546;
    const std::vector<Landing> light = landings(lens, field);
    Mtf mtf;
    for (int i = 0; i <= kSteps; ++i) {
        const double lp_mm = most_lp_mm * i / kSteps, limit = diffraction_limit(lp_mm * kGreen_mm * f_number);
        mtf.tangential.push_back({lp_mm, limit * contrast(light, &Landing::along_um, lp_mm / 1000)});
        mtf.sagittal.push_back({lp_mm, limit * contrast(light, &Landing::across_um, lp_mm / 1000)});
    }
    return mtf;
}

}  // namespace

std::vector<Figure> mtf_figures(const Subject& subject) {
    const bool has_field = subject.prescription() && subject.facts().field_deg > 0.05;
    const std::array<double, 3> fields{0, 0.6, 0.9};
    // The highest frequency drawn resolves 1/1500 of the frame's width: 42 line pairs per mm on 36 mm.
    const double most_lp_mm = 1500 / subject.sensor_width_mm();
    std::vector<Figure> figures;
    for (const double stops : {0.0, 2.0}) {
        const double n = subject.f_number() * std::pow(2, stops / 2);
        const auto lens = subject.mounted(n);
        if (!lens) continue;
        std::array<Mtf, 3> mtf;
        parallel_for(has_field ? 3 : 1, subject.workers(), [&](int i) {
            mtf[std::size_t(i)] = mtf_of(**lens, n, fields[std::size_t(i)], most_lp_mm);
        });
        Plot plot(544, 300, "Contrast at f/" + significant(n, 2), {0, most_lp_mm, "line pairs per mm"},
                  {0, 1, "contrast (MTF)"});
        std::vector<Point> limit;
        for (const Point& p : mtf[0].tangential)
            limit.push_back({p.x, diffraction_limit(p.x * 0.000546 * n)});
        plot.curve(limit, "mark").curve(mtf[0].tangential, "ray0 bold");
        if (has_field)
            for (std::size_t i = 1; i < 3; ++i) {
                const std::string css = i == 1 ? "ray1 bold" : "ray2 bold";
                plot.curve(mtf[i].tangential, css).curve(mtf[i].sagittal, css + " broken");
            }
        figures.push_back({plot.str(), "", 6});
    }
    if (figures.empty()) return figures;
    const auto degrees = [&](double field) {
        return number(std::atan(field * std::tan(subject.corner_deg() * std::numbers::pi / 180)) * 180 /
                          std::numbers::pi,
                      1) +
               "°";
    };
    figures.front().caption =
        "Contrast of fine stripes in white light, at best focus on the axis. " +
        (has_field ? "Red: on the axis; blue: " + degrees(fields[1]) + "; violet: " + degrees(fields[2]) +
                         " off the axis, for stripes across the radius (solid) and along it (dashed)."
                   : std::string()) +
        " Dotted: a perfect lens.";
    figures.back().caption =
        "Two stops down. The contrast is computed from rays and multiplied by the limit of diffraction; it "
        "is a few percent too low where aberrations are about one wave. The scale ends at 1500 line pairs "
        "per frame width.";
    return figures;
}

}  // namespace petzval::lens_sheet
