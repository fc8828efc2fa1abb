#include "optics/beam.h"

#include "optics/least_squares.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace petzval::optics {
namespace {

// Aiming is finished when the stop is met within this share of its radius.
constexpr double kAimed = 1e-9;

}  // namespace

// x^i and y^i up to the map's highest degree.
struct Beam::Powers {
    explicit Powers(Point p) {
        for (int i = 1; i < 8; ++i) x[i] = x[i - 1] * p.x, y[i] = y[i - 1] * p.y;
    }
    double x[8] = {1}, y[8] = {1};
};

// Directions and object for a field angle; the chief ray is not known yet.
void Beam::point_at(double field_rad) {
    const Point outward{std::sin(object_.turned_rad), std::cos(object_.turned_rad)};
    const double sine = std::sin(field_rad), cosine = std::cos(field_rad);
    direction_ = {sine * outward.x, sine * outward.y, cosine};
    across_ = {cosine * outward.x, cosine * outward.y, -sine};
    aside_ = {outward.y, -outward.x, 0};
    if (std::isfinite(object_.distance_mm)) {
        const double off_axis = -object_.distance_mm * std::tan(field_rad);
        object_position_ = {off_axis * outward.x, off_axis * outward.y,
                            entrance_pupil_mm_ - object_.distance_mm};
    }
}

Ray Beam::launch(Point at) const {
    const Vec3 through = Vec3{0, 0, entrance_pupil_mm_} + at.x * aside_ + at.y * across_;
    if (std::isinf(object_.distance_mm)) return {through, direction_};
    return {through, normalised(through - object_position_)};
}

std::optional<Beam::AtStop> Beam::stop_from_launch(Point at) const {
    return on_stop(trace(*lens_, launch(at), 0, lens_->stop));
}

std::array<std::optional<Beam::AtStop>, 2> Beam::stop_from_two(Point a, Point b) const {
    const auto traced = trace_two(*lens_, {launch(a), launch(b)}, 0, lens_->stop);
    return {on_stop(traced[0]), on_stop(traced[1])};
}

std::optional<Beam::AtStop> Beam::on_stop(TracedRay traced) const {
    if (traced.fate != RayFate::Passed) return std::nullopt;
    const auto stop = std::size_t(lens_->stop);
    if (stop > 0) traced.ray.position.z -= lens_->surfaces[stop - 1].thickness_mm;
    const auto hit = intersect(lens_->surfaces[stop], traced.ray);
    if (!hit) return std::nullopt;
    return AtStop{hit->x / stop_radius_mm_, hit->y / stop_radius_mm_, traced};
}

// Meridional launch coordinate of the ray through the stop's centre, by Newton's method from a guess.
std::optional<double> Beam::solve_chief(double guess) const {
    const double step = 1e-5 * scale_.y;
    double y = guess;
    auto here = stop_from_launch({0, y});
    for (int iteration = 0; here && iteration < 40; ++iteration) {
        if (std::abs(here->y) < kAimed) return y;
        const auto beside = stop_from_launch({0, y + step});
        if (!beside || beside->y == here->y) return std::nullopt;
        double change = -here->y * step / (beside->y - here->y);
        // Never leave the region where rays reach the stop.
        auto next = stop_from_launch({0, y + change});
        for (int halving = 0; halving < 10 && (!next || std::abs(next->y) > std::abs(here->y)); ++halving)
            next = stop_from_launch({0, y + (change /= 2)});
        y += change;
        here = next;
    }
    return std::nullopt;
}

// Follows the chief ray from the axis to the wanted field in steps that shrink where it bends.
bool Beam::find_chief() {
    const double wanted = object_.field_rad;
    point_at(0);
    const auto beside = stop_from_launch({0, 1e-4 * stop_radius_mm_});
    if (!beside || beside->y == 0) return false;
    scale_.y = 1e-4 * stop_radius_mm_ / beside->y;

    double field = 0, offset = 0, rate = 0;
    double step = 5 * std::numbers::pi / 180;
    while (field < wanted) {
        const double next = std::min(field + step, wanted);
        point_at(next);
        const auto found = solve_chief(offset + rate * (next - field));
        if (!found) {
            step /= 2;
            if (step < 1e-4) return false;
            continue;
        }
        rate = (*found - offset) / (next - field);
        field = next;
        offset = *found;
    }
    point_at(wanted);
    chief_ = {0, offset};
    return true;
}

// The same in both directions, of a lens with cylinders.
bool Beam::find_chief_askew() {
    const double wanted = object_.field_rad, step_mm = 1e-4 * stop_radius_mm_;
    point_at(0);
    const auto aside = stop_from_launch({step_mm, 0}), up = stop_from_launch({0, step_mm});
    if (!aside || !up) return false;
    scale_ = {step_mm / std::hypot(aside->x, aside->y), step_mm / std::hypot(up->x, up->y)};
    double field = 0, step = 5 * std::numbers::pi / 180;
    Point rate{};
    while (field < wanted) {
        const double next = std::min(field + step, wanted);
        point_at(next);
        const auto found =
            aim_carefully({0, 0}, {chief_.x + rate.x * (next - field), chief_.y + rate.y * (next - field)});
        if (!found) {
            step /= 2;
            if (step < 1e-4) return false;
            continue;
        }
        rate = {(found->launch.x - chief_.x) / (next - field), (found->launch.y - chief_.y) / (next - field)};
        chief_ = found->launch;
        field = next;
    }
    point_at(wanted);
    const double dx = 1e-4 * scale_.x, dy = 1e-4 * scale_.y;
    const auto here = stop_from_launch(chief_), right = stop_from_launch({chief_.x + dx, chief_.y}),
               above = stop_from_launch({chief_.x, chief_.y + dy});
    if (!here || !right || !above) return false;
    const Point of_x{(right->x - here->x) / dx, (right->y - here->y) / dx},
        of_y{(above->x - here->x) / dy, (above->y - here->y) / dy};
    const double determinant = of_x.x * of_y.y - of_x.y * of_y.x;
    if (determinant == 0) return false;
    by_x_ = {of_y.y / determinant, -of_x.y / determinant};
    by_y_ = {-of_y.x / determinant, of_x.x / determinant};
    return true;
}

bool Beam::measure_scale() {
    const double step = 1e-4 * std::abs(scale_.y);
    const auto right = stop_from_launch({step, chief_.y});
    const auto up = stop_from_launch({0, chief_.y + step}), down = stop_from_launch({0, chief_.y - step});
    if (!right || !up || !down || right->x == 0 || up->y == down->y) return false;
    scale_ = {step / right->x, 2 * step / (up->y - down->y)};
    by_x_ = {scale_.x, 0};
    by_y_ = {0, scale_.y};
    return std::isfinite(scale_.x) && std::isfinite(scale_.y);
}

// Newton's method with differences; `start` is a launch point known to reach the stop near the target.
std::optional<Beam::Aimed> Beam::aim_carefully(Point stop, Point start) const {
    const double dx = 1e-5 * scale_.x, dy = 1e-5 * scale_.y;
    Point at = start;
    auto here = stop_from_launch(at);
    for (int iteration = 0; here && iteration < 25; ++iteration) {
        const Point miss{here->x - stop.x, here->y - stop.y};
        const double missed = std::sqrt(miss.x * miss.x + miss.y * miss.y);
        if (missed < kAimed) return Aimed{at, here->before};
        const auto [right, up] = stop_from_two({at.x + dx, at.y}, {at.x, at.y + dy});
        if (!right || !up) return std::nullopt;
        const double xx = (right->x - here->x) / dx, yx = (right->y - here->y) / dx;
        const double xy = (up->x - here->x) / dy, yy = (up->y - here->y) / dy;
        const double determinant = xx * yy - xy * yx;
        if (determinant == 0) return std::nullopt;
        Point change{-(yy * miss.x - xy * miss.y) / determinant, -(xx * miss.y - yx * miss.x) / determinant};
        std::optional<AtStop> next;
        for (int halving = 0; halving < 8; ++halving) {
            next = stop_from_launch({at.x + change.x, at.y + change.y});
            if (next && std::hypot(next->x - stop.x, next->y - stop.y) < missed) break;
            change = {change.x / 2, change.y / 2};
        }
        at = {at.x + change.x, at.y + change.y};
        here = next;
    }
    return std::nullopt;
}

// Rays that land on or near rings of the stop, or of its half x >= 0 where the other half mirrors it, each
// aimed by the two before it on its spoke; then the polynomial of highest degree that they determine. Where a
// ray really lands is what counts, so only one that misses its ring is aimed by Newton's method.
void Beam::fit_map() {
    constexpr int kRings = 6, kSpokes = 13;
    const int spokes = lens_->round ? kSpokes : 2 * kSpokes - 2;
    constexpr double kNear = 0.02;  // in stop radii; the outermost rings are 0.034 apart
    std::vector<Point> stop{{0, 0}}, launched{chief_};
    for (int spoke = 0; spoke < spokes; ++spoke) {
        const double angle = std::numbers::pi * (double(spoke) / (kSpokes - 1) - 0.5);
        const Point along{std::cos(angle), std::sin(angle)};
        Point from = chief_,
              rate{by_x_.x * along.x + by_y_.x * along.y, by_x_.y * along.x + by_y_.y * along.y};
        double reached = 0;
        for (int ring = 1; ring <= kRings; ++ring) {
            const double r = std::sin(std::numbers::pi / 2 * ring / kRings);  // denser towards the rim
            const double step = r - reached;
            Point at{from.x + step * rate.x, from.y + step * rate.y}, lands{r * along.x, r * along.y};
            const auto here = stop_from_launch(at);
            if (here && std::hypot(here->x - lands.x, here->y - lands.y) < kNear) {
                lands = {here->x, here->y};
            } else {
                const auto aimed = aim_carefully(lands, from);
                if (!aimed) break;
                at = aimed->launch;
            }
            rate = {(at.x - from.x) / step, (at.y - from.y) / step};
            from = at;
            reached = r;
            stop.push_back(lands);
            launched.push_back(at);
        }
    }
    for (const int degree : {7, 5, 3, 1})
        if (fit(stop, launched, degree)) return;
    map_x_ = {{0, 0, chief_.x}, {1, 0, by_x_.x}, {0, 1, by_y_.x}};
    map_y_ = {{0, 0, chief_.y}, {1, 0, by_x_.y}, {0, 1, by_y_.y}};
}

bool Beam::fit(const std::vector<Point>& stop, const std::vector<Point>& launched, int degree) {
    const int step = lens_->round ? 2 : 1;  // mirror symmetry: x odd or even
    const auto one = [&](int parity, auto component, std::vector<Term>& map) {
        map.clear();
        for (int i = parity; i <= degree; i += step)
            for (int j = 0; i + j <= degree; ++j) map.push_back({i, j, 0});
        if (stop.size() < map.size() + map.size() / 2) return false;
        std::vector<std::vector<double>> rows;
        std::vector<double> target;
        for (std::size_t k = 0; k < stop.size(); ++k) {
            auto& row = rows.emplace_back();
            const Powers powers(stop[k]);
            for (const Term& term : map) row.push_back(powers.x[term.i] * powers.y[term.j]);
            target.push_back(component(launched[k]));
        }
        const auto solution = least_squares(std::move(rows), std::move(target));
        for (std::size_t k = 0; k < solution.size(); ++k) map[k].coefficient = solution[k];
        return !solution.empty();
    };
    return one(
               lens_->round ? 1 : 0, [](Point p) { return p.x; }, map_x_) &&
           one(
               0, [](Point p) { return p.y; }, map_y_);
}

Beam::Guess Beam::guess(double stop_x, double stop_y) const {
    const Powers p({stop_x, stop_y});
    Guess g;
    const auto add = [&](const std::vector<Term>& map, double& value, double& by_x, double& by_y) {
        for (const auto& [i, j, c] : map) {
            value += c * p.x[i] * p.y[j];
            if (i > 0) by_x += c * i * p.x[i - 1] * p.y[j];
            if (j > 0) by_y += c * j * p.x[i] * p.y[j - 1];
        }
    };
    add(map_x_, g.at.x, g.by_x.x, g.by_y.x);
    add(map_y_, g.at.y, g.by_x.y, g.by_y.y);
    return g;
}

// The map's derivative is nearly the true one, so correcting by it converges in a step or two.
std::optional<Beam::Aimed> Beam::aim(Point stop) const {
    const Guess g = guess(stop.x, stop.y);
    Point at = g.at;
    double last_miss = 1e9;
    for (int iteration = 0; iteration < 12; ++iteration) {
        const auto here = stop_from_launch(at);
        if (!here) break;
        const Point miss{here->x - stop.x, here->y - stop.y};
        const double missed = std::sqrt(miss.x * miss.x + miss.y * miss.y);
        if (missed < kAimed) return Aimed{at, here->before};
        if (missed > 0.5 * last_miss) break;
        last_miss = missed;
        at.x -= g.by_x.x * miss.x + g.by_y.x * miss.y;
        at.y -= g.by_x.y * miss.x + g.by_y.y * miss.y;
    }
    return aim_carefully(stop, g.at);
}

Result<Beam> Beam::make(std::shared_ptr<const LensAtWavelength> lens, const ObjectPoint& object,
                        double entrance_pupil_mm, double stop_radius_mm, double sensor_distance_mm) {
    if (std::isfinite(object.distance_mm) && !(object.field_rad < 0.999 * std::numbers::pi / 2))
        return Error{ErrorCode::InvalidArgument,
                     "a field of 90 degrees or more has no object plane at a finite "
                     "distance: focus at infinity"};
    Beam beam;
    beam.lens_ = std::move(lens);
    beam.object_ = object;
    beam.entrance_pupil_mm_ = entrance_pupil_mm;
    beam.stop_radius_mm_ = stop_radius_mm;
    beam.sensor_distance_mm_ = sensor_distance_mm;
    const bool found =
        beam.lens_->round ? beam.find_chief() && beam.measure_scale() : beam.find_chief_askew();
    if (!found) {
        std::ostringstream text;
        text << "no ray from " << object.field_rad * 180 / std::numbers::pi
             << " degrees off the axis passes the centre of the stop: the field is larger than the lens "
                "covers";
        return Error{ErrorCode::InvalidArgument, text.str()};
    }
    beam.fit_map();
    const Guess centre = beam.guess(0, 0);
    beam.chief_flux_ = std::abs(centre.by_x.x * centre.by_y.y - centre.by_x.y * centre.by_y.x);
    return beam;
}

std::optional<Ray> Beam::entering(double stop_x, double stop_y) const noexcept {
    const auto aimed = aim({stop_x, stop_y});
    if (!aimed) return std::nullopt;
    return launch(aimed->launch);
}

SensorRay Beam::ray(double stop_x, double stop_y) const noexcept {
    SensorRay result;
    const Guess g = guess(stop_x, stop_y);
    result.flux = std::abs(g.by_x.x * g.by_y.y - g.by_x.y * g.by_y.x) / chief_flux_;
    const auto aimed = aim({stop_x, stop_y});
    if (!aimed) return result;
    const TracedRay traced = trace(*lens_, aimed->before_stop.ray, lens_->stop, lens_->count());
    if (traced.fate != RayFate::Passed || !(traced.ray.direction.z > 0)) return result;

    const Vec3 landing = at_plane(traced.ray, sensor_distance_mm_);
    const Vec3& d = traced.ray.direction;
    result.reached = true;
    result.clearance = std::max(aimed->before_stop.clearance, traced.clearance);
    result.x_mm = lens_->squeeze * landing.x;
    result.y_mm = landing.y;
    result.slope_x = lens_->squeeze * d.x / d.z;
    result.slope_y = d.y / d.z;

    if (std::isfinite(object_.distance_mm)) {
        // Solid angle of an element of the launch plane: area times cos / distance^2, cos ~ 1 / distance.
        const Vec3 chief = launch(chief_).position - object_position_;
        const Vec3 here = launch(aimed->launch).position - object_position_;
        result.flux *= std::pow(length(chief) / length(here), 3);
    }
    return result;
}

}  // namespace petzval::optics
