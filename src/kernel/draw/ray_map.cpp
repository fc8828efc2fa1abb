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

// Points on rings, or on half rings that the other half mirrors, that fill what is open of the stop, and a
// little more.
std::vector<Point> sample_points(const OpenStop& open) {
    constexpr int kRings = 11;
    constexpr double kMargin = 1.0;
    std::vector<Point> points{open.middle};
    const std::size_t turn = open.is_mirrored ? open.corners.size() / 2 : open.corners.size();
    for (int j = 1; j <= kRings; ++j) {
        const double share = std::sin(0.5 * kPi * j / kRings);  // denser towards the rim, where maps bend
        const std::size_t count = std::size_t(5 + j) * (open.is_mirrored ? 1 : 2);
        for (std::size_t k = 0; k < count + (open.is_mirrored ? 1 : 0); ++k) {
            const Point to_corner = kMargin * (open.corners[k * turn / count] - open.middle);
            // Up to the rim of the stop: |middle + t to_corner| = 1.
            const double a = to_corner.x * to_corner.x + to_corner.y * to_corner.y,
                         b = open.middle.x * to_corner.x + open.middle.y * to_corner.y;
            const double c = open.middle.x * open.middle.x + open.middle.y * open.middle.y - 1;
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
template <typename Sample>
std::vector<std::vector<double>> even_columns(const std::vector<Sample>& samples, bool and_odd) {
    auto all = columns(samples, &PupilPowers::even);
    if (and_odd)
        for (auto& column : columns(samples, &PupilPowers::odd)) all.push_back(std::move(column));
    return all;
}

// Coefficients of even powers, and of odd ones if there are more.
void set(const std::vector<double>& from, std::array<double, kEvenTerms>& even,
         std::array<double, kOddTerms>& odd) {
    std::copy(from.begin(), from.begin() + kEvenTerms, even.begin());
    std::copy(from.begin() + kEvenTerms, from.end(), odd.begin());
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
    if (!is_skew) return sum;
    for (std::size_t i = 0; i < along_odd.size(); ++i) sum.x += along_odd[i] * powers.odd[i];
    for (std::size_t i = 0; i < across_even.size(); ++i) sum.y += across_even[i] * powers.even[i];
    return sum;
}

Displacement& Displacement::add(double factor, const Displacement& other) {
    for (std::size_t i = 0; i < along.size(); ++i) along[i] += factor * other.along[i];
    for (std::size_t i = 0; i < across.size(); ++i) across[i] += factor * other.across[i];
    if (!other.is_skew) return *this;
    is_skew = true;
    for (std::size_t i = 0; i < along_odd.size(); ++i) along_odd[i] += factor * other.along_odd[i];
    for (std::size_t i = 0; i < across_even.size(); ++i) across_even[i] += factor * other.across_even[i];
    return *this;
}

RayMap& RayMap::add(double factor, const RayMap& other) {
    offset_mm.add(factor, other.offset_mm);
    slope.add(factor, other.slope);
    per_coc.add(factor, other.per_coc);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += factor * other.light[i];
    for (std::size_t i = 0; i < light_odd.size(); ++i) light_odd[i] += factor * other.light_odd[i];
    return *this;
}

RayMapFitter::RayMapFitter(const optics::Beam& primary, const OpenStop& open)
    : chief_(primary.ray(0, 0)),
      is_skew_(!open.is_mirrored),
      samples_(traced(primary, open)),
      even_(even_columns(samples_, is_skew_)),
      odd_(columns(samples_, &PupilPowers::odd)) {}

std::vector<RayMapFitter::Sample> RayMapFitter::traced(const optics::Beam& primary, const OpenStop& open) {
    const optics::SensorRay chief = primary.ray(0, 0);
    const auto square = [&](const Sample& s) {
        return (s.primary.x_mm - chief.x_mm) * (s.primary.x_mm - chief.x_mm) +
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
        const Point offset = on_picture(ray.x_mm - chief_.x_mm, ray.y_mm - chief_.y_mm);
        const Point slope = on_picture(ray.slope_x - chief_.slope_x, ray.slope_y - chief_.slope_y);
        const double values[] = {offset.x, offset.y, slope.x, slope.y, ray.flux};
        for (std::size_t i = 0; i < targets.size(); ++i) targets[i].push_back(s.weight * values[i]);
    }
    RayMap map;
    map.offset_mm = fitted(targets[0], targets[1]);
    map.slope = fitted(targets[2], targets[3]);
    set(even_.solve(targets[4]), map.light, map.light_odd);
    return map;
}

Displacement RayMapFitter::fitted(std::vector<double> along, std::vector<double> across) const {
    Displacement map;
    set(even_.solve(std::move(along)), map.along, map.along_odd);
    map.is_skew = is_skew_;
    if (is_skew_) {
        set(even_.solve(std::move(across)), map.across_even, map.across);
    } else {
        const auto odd = odd_.solve(std::move(across));
        std::copy(odd.begin(), odd.end(), map.across.begin());
    }
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
                             : on_picture(p.x_mm - chief_.x_mm + shift_mm * (p.slope_x - chief_.slope_x),
                                          p.y_mm - chief_.y_mm + shift_mm * (p.slope_y - chief_.slope_y));
        targets[0].push_back(s.weight * at.x), targets[1].push_back(s.weight * at.y);
    }
    return fitted(std::move(targets[0]), std::move(targets[1]));
}

OpenStop OpenStop::of(const optics::Beam& beam, int corners) {
    // The middle of the transmitted light, on a coarse grid.
    constexpr int kGrid = 12;
    OpenStop open;
    open.is_mirrored = beam.is_mirrored();
    int count = 0;
    for (int j = open.is_mirrored ? 0 : -kGrid; j <= kGrid; ++j)
        for (int i = -kGrid; i <= kGrid; ++i) {
            const Point p{double(i) / kGrid, double(j) / kGrid};
            if (p.x * p.x + p.y * p.y > 1 || !passes(ray_through(beam, p))) continue;
            open.middle = open.middle + p;
            ++count;
        }
    if (count == 0) return open;
    open.middle.x /= count;
    open.middle.y = open.is_mirrored ? 0 : open.middle.y / count;
    open.corners.resize(std::size_t(corners));
    for (int k = 0; k <= (open.is_mirrored ? corners / 2 : corners - 1); ++k) {
        const Point along{std::cos(2 * kPi * k / corners), std::sin(2 * kPi * k / corners)};
        double inside = 0, outside = kBeyondStop + std::hypot(open.middle.x, open.middle.y);
        if (passes(ray_through(beam, open.middle + outside * along))) inside = outside;
        for (int step = 0; step < 14 && inside < outside; ++step) {
            const double between = 0.5 * (inside + outside);
            (passes(ray_through(beam, open.middle + between * along)) ? inside : outside) = between;
        }
        const Point corner = open.middle + inside * along;
        if (open.is_mirrored) open.corners[std::size_t((corners - k) % corners)] = {corner.x, -corner.y};
        open.corners[std::size_t(k)] = corner;
    }
    return open;
}

}  // namespace petzval::kernel
