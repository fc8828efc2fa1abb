// The lens in section: glass, stop, rays of the axis and of two field points, the image plane.
#include "lens_sheet/frame.h"
#include "optics/traced_lens.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr double kTallest = 400, kWords = 84;
constexpr double kDegree = std::numbers::pi / 180;
constexpr int kArcSteps = 24;

struct Bundle {
    double field_deg = 0;
    std::vector<std::vector<Point>> paths;  // (z, y) in mm, from in front of the lens to the sensor
};

struct Layout {
    optics::LensAtWavelength at;
    std::vector<double> vertex_mm, radius_mm;  // of each surface
    double sensor_mm = 0, half_image_mm = 0, tallest_mm = 0, lead_mm = 0;
    std::vector<Bundle> bundles;
};

// Points of a ray on each surface, then the sensor; it starts `lead_mm` before the first surface.
std::vector<Point> path_of(const Layout& layout, optics::Ray ray) {
    std::vector<Point> path;
    const optics::Ray entering = ray;
    for (int i = 0; i < layout.at.count(); ++i) {
        if (i > 0) ray.position.z -= layout.at.surfaces[std::size_t(i) - 1].thickness_mm;
        const optics::TracedRay step = optics::trace(layout.at, ray, i, i + 1);
        if (step.fate != optics::RayFate::Passed) return {};
        ray = step.ray;
        path.push_back({layout.vertex_mm[std::size_t(i)] + ray.position.z, ray.position.y});
    }
    const optics::Vec3 end = optics::at_plane(ray, layout.sensor_mm - layout.vertex_mm.back());
    path.push_back({layout.sensor_mm, end.y});
    // At least so far in front, less for steep rays.
    const Point first = path.front();
    const double dz = std::min(layout.lead_mm, layout.lead_mm * entering.direction.z * 1.2);
    path.insert(path.begin(), {first.x - dz, first.y - dz * entering.direction.y / entering.direction.z});
    return path;
}

Bundle bundle_of(const Layout& layout, const optics::TracedLens& lens, double field_deg) {
    Bundle bundle{field_deg, {}};
    const auto beam = lens.beam(lens.prescription().primary_um, field_deg * kDegree);
    if (!beam) return bundle;
    constexpr int kRays = 7;
    for (int k = 0; k < kRays; ++k) {
        const double stop = 2.0 * k / (kRays - 1) - 1;
        const auto entering = beam->entering(0, 0.999 * stop);
        if (!entering || beam->ray(0, 0.999 * stop).clearance > 1.001) continue;
        const auto path = path_of(layout, *entering);
        if (!path.empty()) bundle.paths.push_back(path);
    }
    return bundle;
}

// Radii of the glass: what is stated, else what the rays need; as far as the surface reaches.
void find_radii(Layout& layout) {
    for (std::size_t i = 0; i < layout.at.surfaces.size(); ++i) {
        const optics::RefractingSurface& s = layout.at.surfaces[i];
        double needed = 0;
        for (const Bundle& bundle : layout.bundles)
            for (const auto& path : bundle.paths) needed = std::max(needed, std::abs(path[i + 1].y));
        double radius = std::isfinite(s.clear_radius_mm) ? s.clear_radius_mm : 1.04 * needed;
        while (radius > 1e-3 && !std::isfinite(s.sag_mm(radius))) radius *= 0.99;
        layout.radius_mm[i] = radius;
        layout.tallest_mm = std::max(layout.tallest_mm, radius);
    }
}

Layout layout_of(const Subject& subject, const optics::TracedLens& lens) {
    const optics::Prescription& p = *subject.prescription();
    Layout layout;
    layout.at = optics::at_wavelength(p, p.primary_um);
    double z = 0;
    for (const auto& s : layout.at.surfaces) {
        layout.vertex_mm.push_back(z);
        layout.radius_mm.push_back(0);
        z += s.thickness_mm;
    }
    layout.sensor_mm = layout.vertex_mm.back() + lens.sensor_distance_mm();
    layout.lead_mm = 0.22 * std::max(layout.sensor_mm, subject.focal_length_mm());
    const double field = subject.facts().field_deg;
    for (const double share : {0.0, 0.7, 1.0})
        if (share == 0 || field > 0.05) layout.bundles.push_back(bundle_of(layout, lens, share * field));
    find_radii(layout);
    for (const Bundle& bundle : layout.bundles)
        for (const auto& path : bundle.paths)
            layout.half_image_mm = std::max(layout.half_image_mm, std::abs(path.back().y));
    layout.tallest_mm = std::max({layout.tallest_mm, layout.half_image_mm, 0.06 * layout.sensor_mm});
    return layout;
}

void draw_element(Svg& svg, const Frame& frame, const Layout& layout, std::size_t front, bool is_flint) {
    const double r0 = layout.radius_mm[front], r1 = layout.radius_mm[front + 1], edge = std::max(r0, r1);
    const auto arc = [&](std::size_t i, double y) {
        return frame(layout.vertex_mm[i] + layout.at.surfaces[i].sag_mm(std::abs(y)), y);
    };
    std::vector<Point> outline;
    for (int k = -kArcSteps; k <= kArcSteps; ++k) outline.push_back(arc(front, r0 * k / kArcSteps));
    outline.push_back({arc(front, r0).x, frame(0, edge).y});
    outline.push_back({arc(front + 1, r1).x, frame(0, edge).y});
    for (int k = kArcSteps; k >= -kArcSteps; --k) outline.push_back(arc(front + 1, r1 * k / kArcSteps));
    outline.push_back({arc(front + 1, r1).x, frame(0, -edge).y});
    outline.push_back({arc(front, r0).x, frame(0, -edge).y});
    svg.path(outline, is_flint ? "glass flint" : "glass", true);
}

void draw_glass(Svg& svg, const Frame& frame, const Layout& layout, const optics::Prescription& p) {
    for (std::size_t i = 0; i + 1 < p.surfaces.size(); ++i)
        if (!p.surfaces[i].after.is_air())
            draw_element(svg, frame, layout, i, p.surfaces[i].after.abbe_number() < 50);
}

void draw_stop(Svg& svg, const Frame& frame, const Layout& layout, double radius_mm, int stop) {
    const auto i = std::size_t(stop);
    const double sag = layout.at.surfaces[i].sag_mm(radius_mm);
    const double z = layout.vertex_mm[i] + (std::isfinite(sag) ? sag : 0);
    const double outer = radius_mm + 0.16 * layout.tallest_mm;
    for (const int side : {-1, 1}) svg.line(frame(z, side * radius_mm), frame(z, side * outer), "stop");
    svg.text(frame(z, outer) + Point{0, -6}, "stop", "note", Anchor::Middle);
}

void draw_rays(Svg& svg, const Frame& frame, const Layout& layout) {
    const char* const classes[] = {"ray0", "ray1", "ray2"};
    for (std::size_t b = 0; b < layout.bundles.size(); ++b)
        for (const auto& path : layout.bundles[b].paths) {
            std::vector<Point> drawn;
            for (const Point& p : path) drawn.push_back(frame(p.x, p.y));
            svg.path(drawn, classes[b]);
        }
}

void draw_words(Svg& svg, const Frame& frame, const Layout& layout, double height) {
    svg.line(frame(layout.sensor_mm, -layout.half_image_mm * 1.06 - 0.02 * layout.tallest_mm),
             frame(layout.sensor_mm, layout.half_image_mm * 1.06 + 0.02 * layout.tallest_mm), "sensor");
    double x = kMargin;
    const char* const classes[] = {"ray0", "ray1", "ray2"};
    for (std::size_t b = 0; b < layout.bundles.size(); ++b) {
        const double field = layout.bundles[b].field_deg;
        svg.text({x, height - 8}, b == 0 ? "— axis" : "— " + number(field, 1) + "° off the axis", classes[b]);
        x += b == 0 ? 80 : 140;
    }
    svg.text({x + 10, height - 8}, "darker glass: flint, Abbe number below 50", "note");
    // A length of round millimetres.
    const double wanted = 90 / frame.scale, power = std::pow(10.0, std::floor(std::log10(wanted)));
    const double bar = wanted >= 5 * power ? 5 * power : wanted >= 2 * power ? 2 * power : power;
    const double right = kWidth - kMargin, y = height - 12;
    svg.line({right - bar * frame.scale, y}, {right, y}, "sensor");
    svg.text({right - bar * frame.scale - 6, y + 4}, significant(bar) + " mm", "label", Anchor::End);
}

// Draws the pupils, principal and focal planes on a separate line below the glass.
void draw_cardinal_points(Svg& svg, const Frame& frame, const Layout& layout, const LensFacts& f, double y) {
    const double last = layout.vertex_mm.back();
    const struct {
        const char* name;
        double z_mm;
    } points[] = {{"F", f.front_focal_position_mm},
                  {"H", f.front_focal_position_mm + f.efl_mm},
                  {"H′", last + f.bfl_mm - f.efl_mm},
                  {"F′", last + f.bfl_mm},
                  {"entrance pupil", f.entrance_pupil_position_mm},
                  {"exit pupil", last + f.exit_pupil_position_mm}};
    for (std::size_t i = 0; i < std::size(points); ++i) {
        const double x = frame(points[i].z_mm, 0).x;
        if (!(x >= kMargin && x <= kWidth - kMargin)) continue;
        svg.line({x, y - 5}, {x, y + 5}, "axis");
        if (i < 4) {
            svg.text({x, y - 8}, points[i].name, "tick", Anchor::Middle);
            continue;
        }
        // Names of pupils stand away from each other.
        const bool is_left = points[i].z_mm < points[9 - i].z_mm;
        svg.text({x + (is_left ? 3 : -3), y + 17}, points[i].name, "tick",
                 is_left ? Anchor::End : Anchor::Start);
    }
    svg.line({kMargin, y}, {kWidth - kMargin, y}, "grid");
}

std::string traced_section(const Subject& subject, const optics::TracedLens& lens) {
    const Layout layout = layout_of(subject, lens);
    double low = -layout.lead_mm;
    for (const Bundle& bundle : layout.bundles)
        for (const auto& path : bundle.paths) low = std::min(low, path.front().x);
    const double length = layout.sensor_mm - low;
    Frame frame;
    frame.left_mm = low;
    frame.scale = std::min((kWidth - 2 * kMargin) / length, (kTallest - 40) / (2 * layout.tallest_mm));
    const double height = std::max(170.0, 2 * layout.tallest_mm * frame.scale + 46) + kWords;
    frame.middle = (height - kWords) / 2 + 6;
    frame.left_mm -= ((kWidth - 2 * kMargin) / frame.scale - length) / 2;

    Svg svg(kWidth, height, "cross-section of " + subject.name() + " with rays");
    svg.line(frame(low, 0), frame(layout.sensor_mm, 0), "optical-axis");
    draw_glass(svg, frame, layout, *subject.prescription());
    svg.open_window({0, 0}, kWidth, height - kWords + 6);
    draw_rays(svg, frame, layout);
    svg.close_window();
    draw_stop(svg, frame, layout, lens.stop_radius_mm(), subject.prescription()->stop);
    draw_cardinal_points(svg, frame, layout, subject.facts(), height - 46);
    draw_words(svg, frame, layout, height);
    return svg.str();
}

}  // namespace

Figure cross_section(const Subject& subject) {
    if (!subject.prescription()) return drawn_section(subject);
    const auto lens = optics::TracedLens::make(*subject.prescription(), {});
    if (!lens) return {"", escaped(lens.error().message), 12};
    return {traced_section(subject, *lens),
            "Light comes from infinity, on the left. Every ray is traced through the published surfaces; "
            "rays that a rim blocks are omitted. The sensor is at the paraxial focus. The scale below shows "
            "the principal planes H and H′, the focal points and the paraxial pupils.",
            12};
}

}  // namespace petzval::lens_sheet
