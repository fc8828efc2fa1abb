// Exact sequential ray trace through the surfaces of a lens, at one wavelength.
//
// Each surface is met in its own frame: vertex at the origin, z along the axis. Conics are solved in closed
// form, aspheres by Newton's method from there; refraction is Snell's law as vectors (W. T. Welford,
// Aberrations of Optical Systems, 1986, ch. 4). A ray that would need the far side of a sphere, another sheet
// of a hyperboloid, or that is totally reflected, ends.
#pragma once

#include "optics/prescription.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace petzval::optics {

struct Vec3 {
    double x = 0, y = 0, z = 0;

    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline double radius(Vec3 a) { return std::sqrt(a.x * a.x + a.y * a.y); }  // from the axis
inline Vec3 normalised(Vec3 a) { return (1 / length(a)) * a; }

// Position in mm in the frame of some surface; direction of unit length.
struct Ray {
    Vec3 position, direction;
};

// A surface with the indices of one wavelength.
struct RefractingSurface {
    double curvature_per_mm = 0, conic = 0;
    double cylinder_per_mm = 0;   // of an upright cylinder, whose other numbers are 0
    std::vector<double> asphere;  // coefficient of r^p at [p]; empty for a conic
    double thickness_mm = 0;
    double index_before = 1, index_after = 1;
    double clear_radius_mm = 0;

    // In the plane of y and z, in which a cylinder is a plane. NaN outside the conic's reach. r in mm >= 0.
    double sag_mm(double r) const;
    double slope(double r) const;              // d sag / d r
    double second_derivative(double r) const;  // d2 sag / d r2, 1/mm
    // Curvature at the vertex, the r^2 term of the asphere included.
    double vertex_curvature_per_mm() const;
};

struct LensAtWavelength {
    double wavelength_um = 0;
    std::vector<RefractingSurface> surfaces;
    int stop = 0;
    bool round = true;   // no surface is a cylinder
    double squeeze = 1;  // by how much the image is shown wider than it is; see TracedLens::squeeze()

    int count() const { return int(surfaces.size()); }
};

// The medium in front is air. Requires: check(lens) succeeded.
LensAtWavelength at_wavelength(const Prescription& lens, double wavelength_um);
// The lens as light in the plane of x and z meets it: each cylinder is a surface of its radius. For paraxial
// rays.
LensAtWavelength from_above(LensAtWavelength lens);

// Intersection of the ray with the surface, both in the surface's frame; nothing if they do not meet.
std::optional<Vec3> intersect(const RefractingSurface& surface, const Ray& ray) noexcept;

enum class RayFate { Passed, Missed, TotalReflection };

struct TracedRay {
    Ray ray;  // in the frame of the last surface reached, behind it if Passed
    RayFate fate = RayFate::Passed;
    int surface = -1;      // the last surface reached, from 0
    double clearance = 0;  // largest (height / clear radius) on the way, the stop's surface excepted; <= 1
                           // passes every rim
};

// Surfaces first…end-1. `ray` is in the frame of surface `first`, in front of it (or virtually so: it may
// start anywhere on its line). Rims do not end rays; see `clearance`.
TracedRay trace(const LensAtWavelength& lens, Ray ray, int first, int end) noexcept;
// Both rays as trace() traces each. It is faster than two calls, since the processor works on both at once.
std::array<TracedRay, 2> trace_two(const LensAtWavelength& lens, const std::array<Ray, 2>& rays, int first,
                                   int end) noexcept;
inline TracedRay trace(const LensAtWavelength& lens, const Ray& ray) noexcept {
    return trace(lens, ray, 0, lens.count());
}

// The point of the ray on the plane z = z_mm of its frame. Requires: direction.z != 0.
inline Vec3 at_plane(const Ray& ray, double z_mm) {
    return ray.position + ((z_mm - ray.position.z) / ray.direction.z) * ray.direction;
}

}  // namespace petzval::optics
