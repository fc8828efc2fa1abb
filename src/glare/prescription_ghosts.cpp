// Ghosts of a prescription: light reflected at surface i, back at surface j < i, and on to the sensor.
//
// Near the axis every height on the way is linear in height y and slope u of the entering ray,
// h = a y + b u (M. Hullin et al., Physically-Based Real-Time Lens Flare Rendering, 2011, trace real rays; S.
// Lee and E. Eisemann, Practical Real-Time Lens-Flare Rendering, 2013, use these matrices). So the stop and
// every rim, seen from in front, are polygons and circles moved by -b u / a and scaled by 1/a: their
// intersection is the bundle that comes through, and the sensor's a and b throw it onto the picture.
// Reflection is a refraction into index -n: u' = -u - 2 c y; thickness counts backwards between i and j.
#include "glare/ghosts.h"
#include "kernel/draw/outline.h"
#include "optics/traced_lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace petzval::glare {
namespace {

using kernel::Point;

// Height and slope as multiples of the entering ray's.
struct Linear {
    double of_y = 0, of_u = 0;
};
Linear combined(double s, Linear a, double t, Linear b) {
    return {s * a.of_y + t * b.of_y, s * a.of_u + t * b.of_u};
}

struct Rim {
    Linear height;
    double radius_mm = 0;
    bool is_stop = false;
};

struct GhostPath {
    std::vector<Rim> rims;
    Linear sensor;
    double reflected = 0;  // share, both reflections
};

struct Channel {
    double wavelength_um;
    kernel::Light unit;
};
const Channel kChannels[] = {{0.610, {1, 0, 0}}, {0.550, {0, 1, 0}}, {0.465, {0, 0, 1}}};

// Share of light reflected at a surface, straight on: Fresnel; with a layer of index 1.38 a quarter of 550 nm
// thick between glass and air (M. Born and E. Wolf, Principles of Optics, 1.6.4).
double reflectance(double n1, double n2, LensCoating coating, double wavelength_um) {
    constexpr double kFluoride = 1.38, kDesign_um = 0.55;
    const bool to_air = std::min(n1, n2) < 1.01;
    if (coating == LensCoating::None || !to_air) return std::pow((n1 - n2) / (n1 + n2), 2);
    const double first = (n1 - kFluoride) / (n1 + kFluoride), second = (kFluoride - n2) / (kFluoride + n2);
    const double wave = 2 * first * second * std::cos(std::numbers::pi * kDesign_um / wavelength_um);
    return (first * first + second * second + wave) / (1 + first * first * second * second + wave);
}

// Follows a ghost's light from surface to surface.
class Follower {
public:
    Follower(const optics::LensAtWavelength& lens, double stop_radius_mm)
        : lens_(lens), stop_radius_mm_(stop_radius_mm) {}

    GhostPath path(int i, int j, double sensor_mm, LensCoating coating) {
        for (int k = 0; k < i; ++k)
            meet(k), refract(k, true), go(lens_.surfaces[std::size_t(k)].thickness_mm);
        meet(i), reflect(i);
        for (int k = i - 1; k > j; --k)
            go(-lens_.surfaces[std::size_t(k)].thickness_mm), meet(k), refract(k, false);
        go(-lens_.surfaces[std::size_t(j)].thickness_mm), meet(j), reflect(j);
        for (int k = j; k + 1 < lens_.count(); ++k)
            go(lens_.surfaces[std::size_t(k)].thickness_mm), meet(k + 1), refract(k + 1, true);
        go(sensor_mm);
        path_.sensor = height_;
        path_.reflected = share(i, coating) * share(j, coating);
        return path_;
    }

private:
    double share(int k, LensCoating coating) const {
        const auto& s = lens_.surfaces[std::size_t(k)];
        return reflectance(s.index_before, s.index_after, coating, lens_.wavelength_um);
    }
    void go(double distance_mm) { height_ = combined(1, height_, distance_mm, slope_); }
    void meet(int k) {
        const auto& s = lens_.surfaces[std::size_t(k)];
        const bool stop = k == lens_.stop;
        path_.rims.push_back({height_, stop ? stop_radius_mm_ : s.clear_radius_mm, stop});
    }
    void refract(int k, bool forwards) {
        const auto& s = lens_.surfaces[std::size_t(k)];
        const double from = forwards ? s.index_before : s.index_after;
        const double to = forwards ? s.index_after : s.index_before;
        slope_ = combined(from / to, slope_, -s.vertex_curvature_per_mm() * (to - from) / to, height_);
    }
    void reflect(int k) {
        slope_ = combined(-1, slope_, -2 * lens_.surfaces[std::size_t(k)].vertex_curvature_per_mm(), height_);
    }

    const optics::LensAtWavelength& lens_;
    double stop_radius_mm_;
    Linear height_{1, 0}, slope_{0, 1};
    GhostPath path_;
};

// Part of the entering wavefront that passes the stop and all rims, mm; the stop's outline at its first
// passage, a circle at later ones.
std::vector<Point> entering(const GhostPath& path, const std::vector<Point>& unit_stop, Point slope) {
    std::vector<Point> outline;
    const auto seen = [&](const Rim& rim) { return -rim.height.of_u / rim.height.of_y * slope; };
    const auto first =
        std::find_if(path.rims.begin(), path.rims.end(), [](const Rim& r) { return r.is_stop; });
    if (first == path.rims.end()) return {};
    for (const Point& p : unit_stop)
        outline.push_back(seen(*first) + first->radius_mm / first->height.of_y * p);
    for (auto rim = path.rims.begin(); rim != path.rims.end() && !outline.empty(); ++rim) {
        if (rim == first || !std::isfinite(rim->radius_mm)) continue;
        const double radius = rim->radius_mm / std::abs(rim->height.of_y);
        outline = kernel::clipped(outline, {seen(*rim), radius}, 0.002 * radius);
    }
    return outline.size() < 3 ? std::vector<Point>{} : outline;
}

struct GhostLens {
    std::array<std::vector<GhostPath>, 3> paths;  // by channel
    std::vector<Point> stop;                      // unit outline
    double focal_length_mm = 0, px_per_mm = 0, pixel_aspect = 1;
};

std::vector<GhostShape> ghosts_of(const GhostLens& lens, Point source_px) {
    // The picture is the sensor turned by 180 degrees: displayed = -sensor, on both axes.
    const auto to_mm = [&](Point px) {
        return (-1 / lens.px_per_mm) * Point{px.x, px.y / lens.pixel_aspect};
    };
    const Point slope = (1 / lens.focal_length_mm) * to_mm(source_px);
    std::vector<GhostShape> ghosts;
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        const std::size_t first = ghosts.size();
        for (const GhostPath& path : lens.paths[c]) {
            GhostShape ghost;
            ghost.outline = entering(path, lens.stop, slope);
            const double flux = std::abs(kernel::area(ghost.outline)) * path.reflected;
            if (!(flux > 0)) continue;
            sum += flux;
            for (Point& p : ghost.outline) {
                const Point at = path.sensor.of_y * p + path.sensor.of_u * slope;
                p = -lens.px_per_mm * Point{at.x, at.y * lens.pixel_aspect};
            }
            ghost.share = flux * kChannels[c].unit;
            ghosts.push_back(std::move(ghost));
        }
        for (std::size_t k = first; k < ghosts.size(); ++k) ghosts[k].share = 1 / sum * ghosts[k].share;
    }
    return ghosts;
}

bool in_range(double x) { return x > 0 && std::isfinite(x); }

}  // namespace

Result<GhostModel> prescription_ghosts(const optics::Prescription& prescription,
                                       const GlareSettings& settings, int width_px) {
    const Camera& camera = settings.camera;
    if (!in_range(camera.focal_length_mm) || !in_range(camera.sensor_width_mm) ||
        !in_range(camera.f_number) || !(camera.focus_distance_m > 0))
        return Error{ErrorCode::InvalidArgument,
                     "ghosts of " + prescription.name +
                         " need a camera: give camera.focal_length_mm, camera.sensor_width_mm, "
                         "camera.f_number and camera.focus_distance_m"};
    const auto own = optics::first_order(prescription, prescription.primary_um);
    if (!own) return own.error();
    const double scale = camera.focal_length_mm / own->focal_length_mm;
    optics::LensSetting setting;
    setting.f_number = camera.f_number > own->f_number ? camera.f_number : 0;  // never wider than open
    setting.focus_distance_mm = 1000 * camera.focus_distance_m;
    const auto traced = optics::TracedLens::make(optics::scaled(prescription, scale), setting);
    if (!traced) return traced.error();

    auto lens = std::make_shared<GhostLens>();
    lens->stop = kernel::aperture_outline(settings.lens.aperture, 0.002);
    lens->focal_length_mm = camera.focal_length_mm;
    lens->px_per_mm = width_px / camera.sensor_width_mm;
    lens->pixel_aspect = settings.place.pixel_aspect;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto glass = optics::at_wavelength(traced->prescription(), kChannels[c].wavelength_um);
        for (int i = 1; i < glass.count(); ++i)
            for (int j = 0; j < i; ++j) {
                const GhostPath path = Follower(glass, traced->stop_radius_mm())
                                           .path(i, j, traced->sensor_distance_mm(), settings.coating);
                if (path.reflected > 0) lens->paths[c].push_back(path);
            }
    }
    return GhostModel([lens](Point source) { return ghosts_of(*lens, source); });
}

}  // namespace petzval::glare
