#include "optics/seidel.h"

#include <algorithm>
#include <cmath>

namespace petzval::optics {
namespace {

// The r^4 coefficient beyond the osculating sphere: what is left of conic and asphere once the r^2 term has
// been taken into the vertex curvature.
double fourth_order_departure(const RefractingSurface& s) {
    const double c = s.curvature_per_mm, c0 = s.vertex_curvature_per_mm();
    const double a4 = s.asphere.size() > 4 ? s.asphere[4] : 0;
    return a4 + ((1 + s.conic) * c * c * c - c0 * c0 * c0) / 8;
}

bool has_odd_low_power(const RefractingSurface& s) {
    return (s.asphere.size() > 1 && s.asphere[1] != 0) || (s.asphere.size() > 3 && s.asphere[3] != 0);
}

struct At {  // one surface: heights, slopes before and behind
    double y, u, u_after, yb, ub;
};

SeidelSums surface_sums(const RefractingSurface& s, const At& ray, double H, double dn_before,
                        double dn_after) {
    const double n = s.index_before, n2 = s.index_after, c = s.vertex_curvature_per_mm();
    const double A = n * (ray.y * c + ray.u), Ab = n * (ray.yb * c + ray.ub);
    const double d_u = ray.u_after / n2 - ray.u / n;
    const double d_1 = 1 / n2 - 1 / n, d_2 = 1 / (n2 * n2) - 1 / (n * n);
    const double d_colour = dn_after / n2 - dn_before / n;
    SeidelSums sums;
    sums.s1 = -A * A * ray.y * d_u;
    sums.s2 = -A * Ab * ray.y * d_u;
    sums.s3 = -Ab * Ab * ray.y * d_u;
    sums.s4 = -H * H * c * d_1;
    sums.s5 = -Ab * (Ab * Ab * ray.y * d_2 - (H + Ab * ray.y) * ray.yb * c * d_1);
    sums.c1 = A * ray.y * d_colour;
    sums.c2 = Ab * ray.y * d_colour;

    const double asphere = 8 * fourth_order_departure(s) * (n2 - n) * ray.y;
    sums.s1 += asphere * ray.y * ray.y * ray.y;
    sums.s2 += asphere * ray.y * ray.y * ray.yb;
    sums.s3 += asphere * ray.y * ray.yb * ray.yb;
    sums.s5 += asphere * ray.yb * ray.yb * ray.yb;
    return sums;
}

}  // namespace

SeidelSums& SeidelSums::operator+=(const SeidelSums& o) {
    s1 += o.s1, s2 += o.s2, s3 += o.s3, s4 += o.s4, s5 += o.s5, c1 += o.c1, c2 += o.c2;
    return *this;
}

SeidelTable seidel(const Prescription& lens, const FirstOrder& first, double field_deg) {
    const auto at = at_wavelength(lens, lens.primary_um);
    const auto at_short = at_wavelength(lens, lens.short_um), at_long = at_wavelength(lens, lens.long_um);
    SeidelTable table;
    table.field_deg = field_deg;
    table.marginal = trace_paraxial(at, marginal_ray(lens, first));
    table.chief = trace_paraxial(at, chief_ray(first, field_deg));
    const ParaxialTrace &m = table.marginal, &ch = table.chief;
    table.lagrange_invariant_mm = ch.slope_before[0] * m.height_mm[0] - m.slope_before[0] * ch.height_mm[0];

    const auto spread = [](const RefractingSurface& s, const RefractingSurface& l,
                           double RefractingSurface::*n) { return s.*n - l.*n; };
    for (std::size_t i = 0; i < at.surfaces.size(); ++i) {
        const RefractingSurface& s = at.surfaces[i];
        const At ray{m.height_mm[i], m.slope_before[i], m.slope_after[i], ch.height_mm[i],
                     ch.slope_before[i]};
        const double dn_before =
            spread(at_short.surfaces[i], at_long.surfaces[i], &RefractingSurface::index_before);
        const double dn_after =
            spread(at_short.surfaces[i], at_long.surfaces[i], &RefractingSurface::index_after);
        table.surfaces.push_back(surface_sums(s, ray, table.lagrange_invariant_mm, dn_before, dn_after));
        table.sum += table.surfaces.back();
        table.complete = table.complete && !has_odd_low_power(s);
    }
    return table;
}

double seidel_field_deg(const Prescription& lens, const FirstOrder& first) {
    if (lens.paraxial_field_deg > 0) return lens.paraxial_field_deg;
    const double field = field_angle_deg(lens, first);
    return field < 89 ? field : 20;
}

WavefrontCoefficients wavefront_coefficients(const SeidelSums& sum, double wavelength_um) {
    const double waves = 1000 / wavelength_um;  // per mm
    return {sum.s1 / 8 * waves, sum.s2 / 2 * waves, sum.s3 / 2 * waves, (sum.s3 + sum.s4) / 4 * waves,
            sum.s5 / 2 * waves};
}

TransverseThirdOrder transverse_third_order(const SeidelTable& table) {
    const SeidelSums& s = table.sum;
    const double scale = 1 / (2 * table.marginal.behind_last().slope);
    return {scale * s.s1,          scale * 3 * s.s2, scale * (3 * s.s3 + s.s4),
            scale * (s.s3 + s.s4), scale * s.s4,     scale * s.s5};
}

FieldCurvatures third_order_field_curvatures(const SeidelTable& table) {
    const SeidelSums& s = table.sum;
    const double h2 = table.lagrange_invariant_mm * table.lagrange_invariant_mm;
    return {(3 * s.s3 + s.s4) / h2, (s.s3 + s.s4) / h2, s.s4 / h2};
}

}  // namespace petzval::optics
