#include "optics/ray_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace petzval::optics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// sum_p a_p r^p and its derivatives, by Horner's rule.
struct Polynomial {
    double value = 0, first = 0, second = 0;
};

Polynomial evaluate(const std::vector<double>& coefficients, double r) {
    Polynomial p;
    for (std::size_t i = coefficients.size(); i-- > 0;) {
        p.second = p.second * r + p.first;
        p.first = p.first * r + p.value;
        p.value = p.value * r + coefficients[i];
    }
    p.second *= 2;
    return p;
}

// The ray's crossing of the conic where it goes from the side before the surface to the side behind it.
std::optional<Vec3> intersect_conic(double c, double conic, const Ray& ray) {
    const Vec3& d = ray.direction;
    // Starts at the point nearest the vertex: far starting points would cost digits.
    const Vec3 o = ray.position - dot(ray.position, d) * d;
    // F(p) = c (x^2 + y^2 + (1 + conic) z^2) - 2 z is positive before, negative behind; along the ray it is
    // a t^2 + 2 b t + f, and falls where b + a t < 0.
    const double k1 = 1 + conic;
    const double a = c * (d.x * d.x + d.y * d.y + k1 * d.z * d.z);
    const double b = c * (o.x * d.x + o.y * d.y + k1 * o.z * d.z) - d.z;
    const double f = c * (o.x * o.x + o.y * o.y + k1 * o.z * o.z) - 2 * o.z;
    const double discriminant = b * b - a * f;
    if (!(discriminant >= 0)) return std::nullopt;
    const double root = std::sqrt(discriminant);
    // Both forms are the root with b + a t = -root; each loses no digits where it is used.
    double t = 0;
    if (b <= 0) {
        if (root - b == 0) return std::nullopt;
        t = f / (root - b);
    } else {
        if (a == 0) return std::nullopt;
        t = -(b + root) / a;
    }
    const Vec3 p = o + t * d;
    if (!(1 - k1 * c * p.z > 0)) return std::nullopt;  // the far side, or another sheet
    return p;
}

// A cylinder is met where the ray's shadow on the plane of x and z meets the circle.
std::optional<Vec3> intersect_cylinder(double c, const Ray& ray) {
    const double share = std::hypot(ray.direction.x, ray.direction.z);  // of the direction's length
    if (!(share > 0)) return std::nullopt;
    const Vec3 shadow{ray.direction.x / share, 0, ray.direction.z / share};
    const Vec3 from{ray.position.x, 0, ray.position.z};
    const auto hit = intersect_conic(c, 0, {from, shadow});
    if (!hit) return std::nullopt;
    const double way = dot(*hit - from, shadow) / share;
    return Vec3{hit->x, ray.position.y + way * ray.direction.y, hit->z};
}

// The point where sag(r) = z, from a first guess on the ray.
std::optional<Vec3> refine_on_asphere(const RefractingSurface& surface, const Ray& ray, Vec3 guess) {
    const Vec3& d = ray.direction;
    Vec3 p = guess;
    for (int iteration = 0; iteration < 50; ++iteration) {
        const double r = radius(p);
        const double gap = p.z - surface.sag_mm(r);
        const double across = r > 0 ? surface.slope(r) * (p.x * d.x + p.y * d.y) / r : 0;
        const double rate = d.z - across;
        if (!std::isfinite(gap) || rate == 0) return std::nullopt;
        const double step = -gap / rate;
        p = p + step * d;
        if (std::abs(step) <= 1e-13 * (r + std::abs(p.z)) + 1e-300) return p;
    }
    return std::nullopt;
}

// Unit normal, towards the light.
Vec3 normal_at(const RefractingSurface& surface, Vec3 p) {
    if (surface.cylinder_per_mm != 0)
        return normalised({surface.cylinder_per_mm * p.x, 0, surface.cylinder_per_mm * p.z - 1});
    if (surface.asphere.empty()) {
        const double c = surface.curvature_per_mm;
        return normalised({c * p.x, c * p.y, c * (1 + surface.conic) * p.z - 1});
    }
    const double r = radius(p);
    if (r == 0) return {0, 0, -1};
    const double per_r = surface.slope(r) / r;
    return normalised({per_r * p.x, per_r * p.y, -1});
}

// Snell's law; nothing at total reflection.
std::optional<Vec3> refract(Vec3 direction, Vec3 normal, double index_ratio) {
    const double cos_in = -dot(normal, direction);
    const double cos_out_squared = 1 - index_ratio * index_ratio * (1 - cos_in * cos_in);
    if (!(cos_out_squared >= 0) || !(cos_in > 0)) return std::nullopt;
    return index_ratio * direction + (index_ratio * cos_in - std::sqrt(cos_out_squared)) * normal;
}

}  // namespace

double RefractingSurface::sag_mm(double r) const {
    const double c = curvature_per_mm;
    const double inside = 1 - (1 + conic) * c * c * r * r;
    if (!(inside >= 0)) return kNaN;
    return c * r * r / (1 + std::sqrt(inside)) + evaluate(asphere, r).value;
}

double RefractingSurface::slope(double r) const {
    const double c = curvature_per_mm;
    const double inside = 1 - (1 + conic) * c * c * r * r;
    return c * r / std::sqrt(inside) + evaluate(asphere, r).first;
}

double RefractingSurface::second_derivative(double r) const {
    const double c = curvature_per_mm;
    const double inside = 1 - (1 + conic) * c * c * r * r;
    return c / (inside * std::sqrt(inside)) + evaluate(asphere, r).second;
}

double RefractingSurface::vertex_curvature_per_mm() const {
    return curvature_per_mm + (asphere.size() > 2 ? 2 * asphere[2] : 0);
}

LensAtWavelength at_wavelength(const Prescription& lens, double wavelength_um) {
    LensAtWavelength result;
    result.wavelength_um = wavelength_um;
    result.stop = lens.stop;
    result.round = is_round(lens);
    double index = 1;
    for (const Surface& surface : lens.surfaces) {
        RefractingSurface to;
        to.curvature_per_mm = surface.curvature_per_mm;
        to.conic = surface.conic;
        to.cylinder_per_mm = surface.cylinder_per_mm;
        to.thickness_mm = surface.thickness_mm;
        to.clear_radius_mm = surface.clear_radius_mm;
        to.index_before = index;
        to.index_after = index = surface.after.index(wavelength_um);
        for (const AsphereTerm& term : surface.asphere) {
            if (term.coefficient == 0) continue;
            if (to.asphere.size() <= std::size_t(term.power)) to.asphere.resize(std::size_t(term.power) + 1);
            to.asphere[std::size_t(term.power)] += term.coefficient;
        }
        result.surfaces.push_back(std::move(to));
    }
    return result;
}

LensAtWavelength from_above(LensAtWavelength lens) {
    for (RefractingSurface& s : lens.surfaces) s.curvature_per_mm += std::exchange(s.cylinder_per_mm, 0);
    lens.round = true;
    return lens;
}

std::optional<Vec3> intersect(const RefractingSurface& surface, const Ray& ray) noexcept {
    if (surface.cylinder_per_mm != 0) return intersect_cylinder(surface.cylinder_per_mm, ray);
    const auto on_conic = intersect_conic(surface.curvature_per_mm, surface.conic, ray);
    if (surface.asphere.empty()) return on_conic;
    if (on_conic) return refine_on_asphere(surface, ray, *on_conic);
    if (ray.direction.z == 0) return std::nullopt;
    return refine_on_asphere(surface, ray, at_plane(ray, 0));
}

namespace {

// Takes a ray through surface i, in whose frame it stands. False where it ends.
bool pass(const LensAtWavelength& lens, int i, TracedRay& traced) noexcept {
    const RefractingSurface& surface = lens.surfaces[std::size_t(i)];
    traced.surface = i;
    const std::optional<Vec3> hit = intersect(surface, traced.ray);
    if (!hit) {
        traced.fate = RayFate::Missed;
        return false;
    }
    traced.ray.position = *hit;
    if (i != lens.stop) traced.clearance = std::max(traced.clearance, radius(*hit) / surface.clear_radius_mm);

    if (surface.index_before == surface.index_after) return true;
    const auto bent =
        refract(traced.ray.direction, normal_at(surface, *hit), surface.index_before / surface.index_after);
    if (!bent) {
        traced.fate = RayFate::TotalReflection;
        return false;
    }
    traced.ray.direction = *bent;
    return true;
}

}  // namespace

TracedRay trace(const LensAtWavelength& lens, Ray ray, int first, int end) noexcept {
    TracedRay result{ray};
    for (int i = first; i < end; ++i) {
        if (i > first) result.ray.position.z -= lens.surfaces[std::size_t(i) - 1].thickness_mm;
        if (!pass(lens, i, result)) break;
    }
    return result;
}

std::array<TracedRay, 2> trace_two(const LensAtWavelength& lens, const std::array<Ray, 2>& rays, int first,
                                   int end) noexcept {
    std::array<TracedRay, 2> results{TracedRay{rays[0]}, TracedRay{rays[1]}};
    for (int i = first; i < end; ++i)
        for (TracedRay& result : results) {
            if (result.fate != RayFate::Passed) continue;
            if (i > first) result.ray.position.z -= lens.surfaces[std::size_t(i) - 1].thickness_mm;
            pass(lens, i, result);
        }
    return results;
}

}  // namespace petzval::optics
