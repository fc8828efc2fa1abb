#include "kernel/draw/ray_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::kernel {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBeyondStop = 1.2;  // how far an outline goes where only the stop cuts

// The stop as the picture shows it, upright: along the field's direction is down in the lens, where light
// goes up.
optics::SensorRay ray_through(const optics::Beam& beam, Point pupil) { return beam.ray(pupil.y, -pupil.x); }

// The picture is turned by 180 degrees against the sensor, and so is the field's direction: along stays,
// across turns.
Point on_picture(double x, double y) { return {y, -x}; }

bool passes(const optics::SensorRay& ray) { return ray.reached && ray.clearance <= 1; }

// Points on half rings that fill what is open of the stop, and a little more; the other half is the mirror
// image.
std::vector<Point> sample_points(const OpenStop& open) {
    constexpr int kRings = 11;
    constexpr double kMargin = 1.0;
    std::vector<Point> points{open.middle};
    const std::size_t half = open.corners.size() / 2;
    for (int j = 1; j <= kRings; ++j) {
        const double share = std::sin(0.5 * kPi * j / kRings);  // denser towards the rim, where maps bend
        const std::size_t count = std::size_t(5 + j);
        for (std::size_t k = 0; k <= count; ++k) {
            const Point to_corner = kMargin * (open.corners[k * half / count] - open.middle);
            // Up to the rim of the stop: |middle + t to_corner| = 1, the middle on the symmetry axis.
            const double a = to_corner.x * to_corner.x + to_corner.y * to_corner.y,
                         b = open.middle.x * to_corner.x;
            const double c = open.middle.x * open.middle.x - 1;
            const double to_rim = (-b + std::sqrt(b * b - a * c)) / a;
            points.push_back(open.middle + share * std::min(1.0, to_rim) * to_corner);
        }
    }
    return points;
}

// One column per power, each row times the sample's weight.
template <typename Sample, std::size_t N>
std::vector<std::vector<double>> columns(const std::vector<Sample>& samples,
                                         const std::array<double, N> PupilPowers::*powers) {
    std::vector<std::vector<double>> columns(N);
    for (const Sample& s : samples) {
        const PupilPowers all(s.pupil);
        for (std::size_t i = 0; i < N; ++i) columns[i].push_back(s.weight * (all.*powers)[i]);
    }
    return columns;
}

}  // namespace

PupilPowers::PupilPowers(Point pupil) {
    std::array<double, kRayMapDegree + 1> along, across;
    along[0] = across[0] = 1;
    for (std::size_t i = 1; i <= kRayMapDegree; ++i)
        along[i] = along[i - 1] * pupil.x, across[i] = across[i - 1] * pupil.y;
    std::size_t e = 0, o = 0;
    for (std::size_t j = 0; j <= kRayMapDegree; ++j)
        for (std::size_t i = 0; i + j <= kRayMapDegree; ++i)
            (j % 2 == 0 ? even[e++] : odd[o++]) = along[i] * across[j];
}

std::size_t place_of_power(std::size_t i, std::size_t j) {
    std::size_t place = i;
    for (std::size_t k = j % 2; k < j; k += 2) place += kRayMapDegree + 1 - k;  // all powers of along
    return place;
}

Point Displacement::at(const PupilPowers& powers) const {
    Point sum;
    for (std::size_t i = 0; i < along.size(); ++i) sum.x += along[i] * powers.even[i];
    for (std::size_t i = 0; i < across.size(); ++i) sum.y += across[i] * powers.odd[i];
    return sum;
}

Displacement& Displacement::add(double factor, const Displacement& other) {
    for (std::size_t i = 0; i < along.size(); ++i) along[i] += factor * other.along[i];
    for (std::size_t i = 0; i < across.size(); ++i) across[i] += factor * other.across[i];
    return *this;
}

RayMap& RayMap::add(double factor, const RayMap& other) {
    offset_mm.add(factor, other.offset_mm);
    slope.add(factor, other.slope);
    per_coc.add(factor, other.per_coc);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += factor * other.light[i];
    return *this;
}

RayMapFitter::RayMapFitter(const optics::Beam& primary, const OpenStop& open)
    : chief_(primary.ray(0, 0)),
      samples_(traced(primary, open)),
      even_(columns(samples_, &PupilPowers::even)),
      odd_(columns(samples_, &PupilPowers::odd)) {}

std::vector<RayMapFitter::Sample> RayMapFitter::traced(const optics::Beam& primary, const OpenStop& open) {
    const optics::SensorRay chief = primary.ray(0, 0);
    const auto square = [&](const Sample& s) {
        return s.primary.x_mm * s.primary.x_mm +
               (s.primary.y_mm - chief.y_mm) * (s.primary.y_mm - chief.y_mm);
    };
    std::vector<Sample> samples;
    double sum = 0;
    for (const Point& p : sample_points(open)) {
        const Sample sample{p, ray_through(primary, p)};
        if (!sample.primary.reached) continue;
        samples.push_back(sample);
        sum += square(sample);
    }
    // Near total reflection a few rays run wild; they must not bend the map of all the others.
    for (Sample& s : samples)
        if (sum > 0) s.weight = 1 / (1 + square(s) * double(samples.size()) / (9 * sum));
    return samples;
}

RayMap RayMapFitter::fit(const optics::Beam& beam) const {
    std::array<std::vector<double>, 5> targets;
    for (const Sample& s : samples_) {
        optics::SensorRay ray = ray_through(beam, s.pupil);
        if (!ray.reached) ray = s.primary;
        const Point offset = on_picture(ray.x_mm, ray.y_mm - chief_.y_mm);
        const Point slope = on_picture(ray.slope_x, ray.slope_y - chief_.slope_y);
        const double values[] = {offset.x, offset.y, slope.x, slope.y, ray.flux};
        for (std::size_t i = 0; i < targets.size(); ++i) targets[i].push_back(s.weight * values[i]);
    }
    RayMap map;
    const auto set = [](const std::vector<double>& from, auto& to) {
        std::copy(from.begin(), from.end(), to.begin());
    };
    set(even_.solve(targets[0]), map.offset_mm.along);
    set(odd_.solve(targets[1]), map.offset_mm.across);
    set(even_.solve(targets[2]), map.slope.along);
    set(odd_.solve(targets[3]), map.slope.across);
    set(even_.solve(targets[4]), map.light);
    return map;
}

Displacement RayMapFitter::landing(const optics::Beam& beam, const optics::SensorRay& chief,
                                   double shift_mm) const {
    std::array<std::vector<double>, 2> targets;
    for (const Sample& s : samples_) {
        const optics::SensorRay ray = ray_through(beam, s.pupil);
        const auto& p = s.primary;
        const Point at = ray.reached
                             ? on_picture(ray.x_mm - chief.x_mm, ray.y_mm - chief.y_mm)
                             : on_picture(p.x_mm + shift_mm * p.slope_x,
                                          p.y_mm - chief_.y_mm + shift_mm * (p.slope_y - chief_.slope_y));
        targets[0].push_back(s.weight * at.x), targets[1].push_back(s.weight * at.y);
    }
    Displacement place;
    const auto along = even_.solve(targets[0]), across = odd_.solve(targets[1]);
    std::copy(along.begin(), along.end(), place.along.begin());
    std::copy(across.begin(), across.end(), place.across.begin());
    return place;
}

OpenStop OpenStop::of(const optics::Beam& beam, int corners) {
    // The middle of the transmitted light, on a coarse grid.
    constexpr int kGrid = 12;
    OpenStop open;
    int count = 0;
    for (int j = 0; j <= kGrid; ++j)
        for (int i = -kGrid; i <= kGrid; ++i) {
            const Point p{double(i) / kGrid, double(j) / kGrid};
            if (p.x * p.x + p.y * p.y > 1 || !passes(ray_through(beam, p))) continue;
            open.middle.x += p.x, ++count;
        }
    if (count == 0) return open;
    open.middle.x /= count;
    open.corners.resize(std::size_t(corners));
    for (int k = 0; k <= corners / 2; ++k) {
        const Point along{std::cos(2 * kPi * k / corners), std::sin(2 * kPi * k / corners)};
        double inside = 0, outside = kBeyondStop + std::abs(open.middle.x);
        if (passes(ray_through(beam, open.middle + outside * along))) inside = outside;
        for (int step = 0; step < 14 && inside < outside; ++step) {
            const double between = 0.5 * (inside + outside);
            (passes(ray_through(beam, open.middle + between * along)) ? inside : outside) = between;
        }
        const Point corner = open.middle + inside * along;
        open.corners[std::size_t((corners - k) % corners)] = {corner.x, -corner.y};
        open.corners[std::size_t(k)] = corner;
    }
    return open;
}

}  // namespace petzval::kernel
