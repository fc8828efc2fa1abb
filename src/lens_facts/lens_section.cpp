#include "petzval/lens_section.h"

#include "kernel/lenses/field_axis.h"
#include "kernel/lenses/geometric_lens.h"
#include "kernel/lenses/make_lens.h"
#include "kernel/lenses/opened_lens.h"
#include "optics/traced_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace petzval {
namespace {

using kernel::Point;

constexpr double kGreen_nm = 546.07;
constexpr int kArcSteps = 16;

Error refuse(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

bool is_inside(const std::vector<Point>& outline, Point p) {
    bool inside = false;
    for (std::size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
        const Point a = outline[i], b = outline[k];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

// The grid over the pupil: what passes and where it lands. Paths are still empty.
std::vector<SectionRay> landed_rays(const kernel::GeometricLens& lens, double coc_px, FieldPosition field,
                                    const kernel::FieldAxis& axis, int across) {
    const auto outline = lens.pupil_outline(field, 0.01);
    const auto landing = lens.landing(kGreen_nm, coc_px, field);
    std::vector<SectionRay> rays;
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < across; ++i) {
            // Grid along the field's direction and across it, so that one row lies in the drawing.
            const Point p = axis.from_axis({2.0 * i / (across - 1) - 1, 2.0 * j / (across - 1) - 1});
            if (!is_inside(outline, {0.999 * p.x, 0.999 * p.y})) continue;
            const Point lands = landing(p);
            rays.push_back({p.x, p.y, lands.x, lands.y, axis.to_axis(p).y, {}});
        }
    return rays;
}

// The paths of rays through surfaces.
class Tracer {
public:
    static Result<Tracer> make(const optics::Prescription& prescription, const Camera& camera) {
        const auto first = optics::first_order(prescription, prescription.primary_um);
        if (!first) return first.error();
        optics::LensSetting setting;
        setting.f_number = std::max(camera.f_number, first->f_number);
        if (camera.focus_distance_m > 0) setting.focus_distance_mm = 1000 * camera.focus_distance_m;
        auto lens = optics::TracedLens::make(
            optics::scaled(prescription, camera.focal_length_mm / first->focal_length_mm), setting);
        if (!lens) return lens.error();
        return Tracer(std::move(*lens));
    }

    Result<LensSection> section(std::vector<SectionRay> rays, const optics::ObjectPoint& object,
                                double lead_mm, const kernel::FieldAxis& axis) const {
        const auto beam = lens_.beam(lens_.prescription().primary_um, object);
        if (!beam) return beam.error();
        LensSection section;
        section.has_surfaces = true;
        section.sensor_z_mm = vertices_.back() + lens_.sensor_distance_mm();
        section.image_y_mm = beam->ray(0, 0).y_mm;
        for (SectionRay& ray : rays) {
            const Point p = axis.to_axis({ray.pupil_x, ray.pupil_y});
            // The field's direction is down in the lens, where light goes up (kernel/draw/ray_map.cpp).
            if (const auto entering = beam->entering(p.y, -p.x)) ray.path = path_of(*entering, lead_mm);
            if (!ray.path.empty()) section.rays.push_back(std::move(ray));
        }
        add_glass(section);
        return section;
    }

private:
    explicit Tracer(optics::TracedLens lens)
        : lens_(std::move(lens)),
          at_(optics::at_wavelength(lens_.prescription(), lens_.prescription().primary_um)) {
        double z = 0;
        for (const auto& surface : at_.surfaces) {
            vertices_.push_back(z);
            z += surface.thickness_mm;
        }
    }

    std::vector<SectionPoint> path_of(optics::Ray ray, double lead_mm) const {
        const optics::Ray entering = ray;
        std::vector<SectionPoint> path;
        for (int i = 0; i < at_.count(); ++i) {
            if (i > 0) ray.position.z -= at_.surfaces[std::size_t(i) - 1].thickness_mm;
            const optics::TracedRay step = optics::trace(at_, ray, i, i + 1);
            if (step.fate != optics::RayFate::Passed) return {};
            ray = step.ray;
            path.push_back({vertices_[std::size_t(i)] + ray.position.z, ray.position.y});
        }
        path.push_back({vertices_.back() + lens_.sensor_distance_mm(),
                        optics::at_plane(ray, lens_.sensor_distance_mm()).y});
        const SectionPoint first = path.front();
        const double dz = first.z_mm + lead_mm;
        path.insert(path.begin(),
                    {-lead_mm, first.y_mm - dz * entering.direction.y / std::max(0.1, entering.direction.z)});
        return path;
    }

    // The stated radius, otherwise the radius that the rays need; at most the surface's extent.
    double radius_of(std::size_t surface, const LensSection& section) const {
        const auto& s = at_.surfaces[surface];
        double needed = 0.02 * lens_.first_order().focal_length_mm;
        for (const SectionRay& ray : section.rays)
            needed = std::max(needed, 1.04 * std::abs(ray.path[surface + 1].y_mm));
        double radius = std::isfinite(s.clear_radius_mm) ? s.clear_radius_mm : needed;
        while (radius > 1e-3 && !std::isfinite(s.sag_mm(radius))) radius *= 0.99;
        return radius;
    }

    void add_glass(LensSection& section) const {
        const optics::Prescription& p = lens_.prescription();
        section.stop_z_mm = vertices_[std::size_t(p.stop)];
        section.stop_radius_mm = lens_.stop_radius_mm();
        for (std::size_t i = 0; i + 1 < p.surfaces.size(); ++i) {
            if (p.surfaces[i].after.is_air()) continue;
            SectionGlass glass{{}, p.surfaces[i].after.abbe_number() < 50};
            const double front = radius_of(i, section), back = radius_of(i + 1, section);
            const auto at = [&](std::size_t surface, double y) {
                return vertices_[surface] + at_.surfaces[surface].sag_mm(std::abs(y));
            };
            for (int k = -kArcSteps; k <= kArcSteps; ++k)
                glass.outline.push_back({at(i, front * k / kArcSteps), front * k / kArcSteps});
            for (int k = kArcSteps; k >= -kArcSteps; --k)
                glass.outline.push_back({at(i + 1, back * k / kArcSteps), back * k / kArcSteps});
            section.glass.push_back(std::move(glass));
        }
    }

    optics::TracedLens lens_;
    optics::LensAtWavelength at_;
    std::vector<double> vertices_;
};

// Section of a lens of curves, without glass: rays bend once.
LensSection thin_section(std::vector<SectionRay> rays, const LensMount& mount, double slope, double depth_mm,
                         double lead_mm, const kernel::FieldAxis& axis) {
    const Camera& camera = mount.camera;
    LensSection section;
    section.sensor_z_mm = camera.focal_length_mm;
    section.stop_radius_mm = 0.5 * camera.focal_length_mm / camera.f_number;
    section.image_y_mm = slope * camera.focal_length_mm;
    const double mm_per_px = camera.sensor_width_mm / mount.width_px;
    for (SectionRay& ray : rays) {
        const double y = -axis.to_axis({ray.pupil_x, ray.pupil_y}).x * section.stop_radius_mm;
        const double outward_px = axis.to_axis({ray.disc_x_px, ray.disc_y_px / mount.pixel_aspect}).x;
        const double converges = std::isinf(depth_mm) ? 0 : y / depth_mm;
        ray.path = {{-lead_mm, y - lead_mm * (slope + converges)},
                    {0, y},
                    {section.sensor_z_mm, section.image_y_mm + outward_px * mm_per_px}};
        section.rays.push_back(std::move(ray));
    }
    return section;
}

}  // namespace

Result<LensSection> lens_section(const Lens& lens, const LensMount& mount, double depth_m, double field_x,
                                 double field_y, int rays_across) {
    if (!(depth_m > 0)) return refuse("section.depth_m must be above 0");
    if (!(std::hypot(field_x, field_y) <= 1.001))
        return refuse("section.field must lie within the half diagonal");
    if (rays_across < 3 || rays_across > 101) return refuse("section.rays_across must be 3 to 101");
    LensChoice choice = lens.choice();
    if (choice.kernel_images.far || choice.kernel_images.near)
        return refuse("lens.kernel_image: a picture of a disc has no rays");
    Lens used = lens;
    if (choice.wave) {
        choice.wave = false;
        auto without = lens.with(choice);
        if (!without) return without.error();
        used = std::move(*without);
    }
    Camera camera = mount.camera;
    if (camera.focus_distance_m == 0) camera.focus_distance_m = std::numeric_limits<double>::infinity();
    const auto coc = CircleOfConfusion::make(camera, mount.width_px);
    if (!coc) return coc.error();
    const auto model =
        kernel::model_on(used, {mount.camera, mount.width_px, mount.height_px, mount.pixel_aspect});
    if (!model) return model.error();
    const auto* of_rays = dynamic_cast<const kernel::GeometricLens*>(model->get());
    if (!of_rays) return refuse("lens.name: this lens has no rays");

    const FieldPosition field{field_x, field_y};
    const optics::Prescription* prescription = kernel::prescription_of(used);
    // Cylinders are drawn as the planes that they are from below; so is light that comes from aside.
    const bool upright = prescription && !optics::is_round(*prescription);
    const kernel::FieldAxis axis = upright ? kernel::FieldAxis::upright(field) : kernel::FieldAxis(field);
    const double turned = upright ? std::atan2(-std::abs(field_x), std::abs(field_y)) : 0;
    const double corner_mm = 0.5 * mount.camera.sensor_width_mm *
                             std::hypot(1.0, mount.height_px / (mount.width_px * mount.pixel_aspect));
    const double slope = axis.size * corner_mm / mount.camera.focal_length_mm;
    const double lead_mm = 0.5 * mount.camera.focal_length_mm;
    auto rays = landed_rays(*of_rays, coc->radius_px(depth_m), field, axis, rays_across);
    if (!prescription) return thin_section(std::move(rays), mount, slope, 1000 * depth_m, lead_mm, axis);
    const auto tracer = Tracer::make(*prescription, mount.camera);
    if (!tracer) return tracer.error();
    return tracer->section(std::move(rays), {std::atan(slope), 1000 * depth_m, turned}, lead_mm, axis);
}

}  // namespace petzval
