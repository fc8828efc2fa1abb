// All rays of one object point at one wavelength, addressed by where they cross the real stop.
//
// The paraxial entrance pupil is only where the stop SEEMS to be near the axis: for a wide lens the bundle
// that really fills the stop enters elsewhere. So the chief ray is found by following the stop's centre from
// the axis outwards in field angle (which holds beyond 90 degrees as well), and a polynomial map from the
// stop to the entering wavefront, fitted to traced rays, gives the first guess that Newton's method
// finishes.
#pragma once

#include "petzval/result.h"

#include "optics/ray_trace.h"

#include <memory>
#include <optional>
#include <vector>

namespace petzval::optics {

// A point of light. Physical axes: the picture on the sensor is turned by 180 degrees.
struct ObjectPoint {
    double field_rad = 0;  // angle of its chief ray with the axis, light going up (+y), so the image is at +y
    double distance_mm = 0;  // along the axis from the paraxial entrance pupil, > 0; infinity allowed
    double turned_rad = 0;   // of the field, about the axis from +y to +x; other than 0 for cylinders only
};

// A ray where it meets the sensor.
struct SensorRay {
    bool reached = false;  // false: no ray through that point of the stop gets through the glass
    double clearance = 0;  // largest (height / clear radius) at any rim but the stop's; <= 1: not vignetted
    double x_mm = 0, y_mm = 0;        // on the sensor, from the axis; x times LensAtWavelength::squeeze
    double slope_x = 0, slope_y = 0;  // dx/dz, dy/dz: a sensor moved by d from the lens adds d * slope
    double flux = 0;  // light per area of the stop, relative to that at its centre; also if not reached
};

// Immutable; safe to use from many threads; ray() allocates nothing.
class Beam {
public:
    // entrance_pupil_mm: paraxial position from the first vertex. stop_radius_mm > 0 is the unit of the stop.
    // sensor_distance_mm: from the last vertex.
    // Errors: InvalidArgument when no ray from there passes the centre of the stop, or when the field is 90
    // degrees or more for a near object.
    static Result<Beam> make(std::shared_ptr<const LensAtWavelength> lens, const ObjectPoint& object,
                             double entrance_pupil_mm, double stop_radius_mm, double sensor_distance_mm);

    // stop_x, stop_y: unit disc of the stop. The flux comes from the Jacobian of the map from the stop to the
    // entering wavefront (to solid angle for near objects): a point lights the entrance evenly, not the stop.
    SensorRay ray(double stop_x, double stop_y) const noexcept;

    // The ray that enters the lens for that point of the stop, in the frame of the first vertex.
    std::optional<Ray> entering(double stop_x, double stop_y) const noexcept;

    // True if the light is symmetric about the plane of y and z.
    bool is_mirrored() const { return lens_->round; }
    const ObjectPoint& object() const { return object_; }
    double wavelength_um() const { return lens_->wavelength_um; }
    double stop_radius_mm() const { return stop_radius_mm_; }

private:
    struct Point {
        double x = 0, y = 0;
    };
    struct Powers;
    // A polynomial of stop coordinates: sum of coefficient x^i y^j.
    struct Term {
        int i = 0, j = 0;
        double coefficient = 0;
    };
    // Launch position for a stop point, with derivatives by stop x and y.
    struct Guess {
        Point at, by_x, by_y;
    };

    // A launched ray at the stop's surface: where it crosses it, in stop radii; the ray just before it, in
    // its frame.
    struct AtStop {
        double x = 0, y = 0;
        TracedRay before;
    };
    // The launch position that meets a stop point.
    struct Aimed {
        Point launch;
        TracedRay before_stop;
    };

    Beam() = default;
    void point_at(double field_rad);
    Ray launch(Point at) const;
    std::optional<AtStop> stop_from_launch(Point at) const;
    std::array<std::optional<AtStop>, 2> stop_from_two(Point a, Point b) const;
    std::optional<AtStop> on_stop(TracedRay traced) const;  // of a ray in front of the stop
    bool find_chief();
    bool find_chief_askew();
    std::optional<double> solve_chief(double guess) const;
    bool measure_scale();
    void fit_map();
    bool fit(const std::vector<Point>& stop, const std::vector<Point>& launched, int degree);
    Guess guess(double stop_x, double stop_y) const;
    std::optional<Aimed> aim(Point stop) const;
    std::optional<Aimed> aim_carefully(Point stop, Point start) const;

    std::shared_ptr<const LensAtWavelength> lens_;
    ObjectPoint object_;
    double entrance_pupil_mm_ = 0, stop_radius_mm_ = 0, sensor_distance_mm_ = 0;

    // The wavefront: launch coordinates count from the paraxial pupil's centre in the plane across
    // direction_.
    Vec3 direction_, across_, aside_{1, 0, 0}, object_position_;
    Point chief_;        // launch coordinates of the chief ray
    Point scale_;        // launch coordinate per unit of the stop, near the chief ray
    Point by_x_, by_y_;  // the same in both directions of the stop
    double chief_flux_ = 1;
    std::vector<Term> map_x_, map_y_;
};

}  // namespace petzval::optics
