// Landing points of the rays of one object point, as polynomials of their positions in the stop.
//
// In a round lens everything is symmetric about the plane through the axis and the object, so along the
// field's direction only even powers of the coordinate across it occur, and across it only odd ones. In a
// lens with cylinders all powers occur, and directions are those of FieldAxis::upright().
#pragma once

#include "kernel/draw/linear_fit.h"
#include "kernel/model/coverage.h"
#include "optics/beam.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace petzval::kernel {

inline constexpr int kRayMapDegree = 9;
inline constexpr int kEvenTerms = 30, kOddTerms = 25;  // of that degree, in two variables

// Powers of a pupil point (along, across) in the order that coefficients are kept in.
struct PupilPowers {
    std::array<double, kEvenTerms> even;
    std::array<double, kOddTerms> odd;

    explicit PupilPowers(Point pupil);
};

// Index of along^i across^j, in `even` if j is even, otherwise in `odd`. Requires: i + j <= kRayMapDegree.
std::size_t place_of_power(std::size_t i, std::size_t j);

// A displacement in the picture, (along, across) the field's direction.
struct Displacement {
    std::array<double, kEvenTerms> along{};
    std::array<double, kOddTerms> across{};
    // The other powers, in a lens with cylinders.
    bool is_skew = false;
    std::array<double, kOddTerms> along_odd{};
    std::array<double, kEvenTerms> across_even{};

    Point at(const PupilPowers& powers) const;
    Displacement& add(double factor, const Displacement& other);
};

// Computes the landing points of many pupil points, several at a time (SIMD); `landed` has room for one per
// point.
void land(const Displacement& map, std::span<const Point> pupil, Point* landed);
struct RayMap;
// Light per area of the pupil at many points; fitted light may fall below 0, and counts as none there.
void lights_at(const RayMap& map, std::span<const Point> pupil, double* lights);

// The part of the stop that no rim but the stop's own cuts off, seen from the beam's object: a polygon around
// its middle, (along, across), corners at even angles from +along. Where nothing is cut it reaches beyond the
// unit disc.
struct OpenStop {
    Point middle;
    std::vector<Point> corners;  // empty: no ray passes
    bool is_mirrored = true;     // corners with across < 0 mirror those with across > 0

    static OpenStop of(const optics::Beam& beam, int corners);
};

// One field position and wavelength. `along` points outward; the far disc of the picture is upright.
struct RayMap {
    Displacement offset_mm;  // landing place, from where the chief ray of the primary wavelength lands
    Displacement slope;      // what a sensor moved by 1 mm away from the lens adds
    Displacement
        per_coc;  // what an object adds that is out of focus, per signed radius: about the pupil point
    std::array<double, kEvenTerms> light{};     // per area of the stop
    std::array<double, kOddTerms> light_odd{};  // its other powers, in a lens with cylinders

    RayMap& add(double factor, const RayMap& other);
};

// The same at one point.
inline double light_at(const RayMap& map, const PupilPowers& powers) {
    double light = 0;
    for (std::size_t i = 0; i < map.light.size(); ++i) light += map.light[i] * powers.even[i];
    if (map.offset_mm.is_skew)
        for (std::size_t i = 0; i < map.light_odd.size(); ++i) light += map.light_odd[i] * powers.odd[i];
    return std::max(0.0, light);
}

// Fits the maps of one field position at several wavelengths, through the same points of the stop.
class RayMapFitter {
public:
    // Through what is open of the stop for the primary wavelength, whose chief ray is the origin.
    RayMapFitter(const optics::Beam& primary, const OpenStop& open);
    // False where too few rays get through.
    bool usable() const {
        return even_.solvable() && odd_.solvable() && samples_.size() > 2 * even_.unknowns();
    }
    // Requires: usable(). Rays that do not get through at this wavelength count as those of the primary one.
    RayMap fit(const optics::Beam& beam) const;
    // The landing of light from another object in the same direction, in mm from the chief ray of its primary
    // wavelength. Rays that do not get through count as those of the object in focus on a sensor moved by
    // shift_mm.
    Displacement landing(const optics::Beam& beam, const optics::SensorRay& chief, double shift_mm) const;

private:
    struct Sample {
        Point pupil;
        optics::SensorRay primary;
        double weight = 1;
    };
    static std::vector<Sample> traced(const optics::Beam& primary, const OpenStop& open);
    // Targets are one number per sample, times its weight.
    Displacement fitted(std::vector<double> along, std::vector<double> across) const;

    optics::SensorRay chief_;
    bool is_skew_;
    std::vector<Sample> samples_;
    LinearFit even_, odd_;  // even_: of all powers, even ones first, in a lens with cylinders
};

}  // namespace petzval::kernel
