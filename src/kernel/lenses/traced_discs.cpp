// The discs of a traced lens: which mesh and how many colours draw one, and where cells of several pixels do.
#include "kernel/draw/band_groups.h"
#include "kernel/draw/halo.h"
#include "kernel/lenses/traced_model.h"
#include "kernel/model/gamut.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

constexpr double kMiddle_nm = 555;
constexpr double kProbed_nm[] = {430, 490, 550, 610, 670};  // wavelengths that count
// Rims of neighbouring bands this far apart are not seen singly: pixels are as wide.
constexpr double kRimStepPx = 1, kNoRimStepPx = 0.02;
constexpr double kSharpPathPx = 6;  // of rims over the spectrum; above, meshes may be coarser
constexpr int kFewestBands = 7, kMostBands = 36;
// A core that reaches farther than this fraction of its kernel is not worth a drawing without the rest.
constexpr double kMostCore = 0.7;

}  // namespace

TracedModel::Fineness TracedModel::fineness(const Node& node, const std::vector<Point>& outline,
                                            double coc_radius_px) const {
    std::vector<Displacement> maps;
    for (const double nm : kProbed_nm) maps.push_back(landing(map_at(node, nm), coc_radius_px));
    Fineness fine;
    for (std::size_t i = 0; i < outline.size(); i += 1 + outline.size() / 24) {
        const PupilPowers powers(outline[i]);
        Point before;
        double path = 0;
        for (std::size_t w = 0; w < maps.size(); ++w) {
            const Point p = maps[w].at(powers), step = p - before;
            fine.size_px = std::max(fine.size_px, std::hypot(p.x, p.y));
            if (w > 0) path += std::hypot(step.x, step.y);
            before = p;
        }
        fine.path_px = std::max(fine.path_px, path);
    }
    // Rays inside the rim may land farther out than the rim.
    fine.size_px = std::max(fine.size_px, std::abs(coc_radius_px));
    fine.bands = bands_for(fine.path_px);
    return fine;
}

int TracedModel::bands_for(double path_px) const {
    if (choice_.wavelengths > 0) return choice_.wavelengths;
    if (wavelength_nm_.size() < 3 || path_px < kNoRimStepPx) return 1;
    return int(std::clamp(std::ceil(path_px / kRimStepPx), double(kFewestBands), double(kMostBands)));
}

// The kernel in cells, or what of it lands within a window.
PointSpread TracedModel::drawn(double coc_radius_px, FieldPosition field, double cell_px,
                               const Rect* window) const {
    const FieldAxis axis = axis_of(field);
    const Node node = at(field);
    Fineness fine = fineness(node, outline(node, axis, field, 1e-3), coc_radius_px);
    fine = {fine.size_px / cell_px, fine.path_px / cell_px, bands_for(fine.path_px / cell_px)};
    const RayMap middle = map_at(node, kMiddle_nm);
    // Colours side by side smear what a coarser mesh would show, and arcs in a window are no longer than it.
    const double smear = std::clamp(fine.path_px / kSharpPathPx, 1.0, 8.0);
    const double size_px = fine.size_px / std::cbrt(smear), along_rim = std::cbrt(smear * smear);
    const double farthest_px = window ? std::min(fine.size_px, double(window->width())) : fine.size_px;
    const double bend_px = 2 * farthest_px - std::min(farthest_px, std::abs(coc_radius_px) / cell_px);
    MeshPupil pupil = mesh_pupil(pupil_, outline(node, axis, field, mesh_tolerance(farthest_px / along_rim)),
                                 size_px, bend_px / along_rim);
    pupil.density = [&](std::span<const Point> points, double* light) { lights_at(middle, points, light); };
    if (pupil_.has_texture())
        pupil.transmission = [&](Point p, double half_width) {
            return pupil_.transmission(axis.from_axis(p), half_width);
        };
    std::vector<MeshBand> bands;
    for (const auto& [weight, landing_px] : colours_of(node, fine, coc_radius_px))
        bands.push_back(
            {weight, [this, cell_px, px = landing_px, axis](std::span<const Point> points, Point* landed) {
                 land(px, points, landed);
                 for (std::size_t i = 0; i < points.size(); ++i) {
                     const Point image = axis.from_axis(landed[i]);
                     landed[i] = {image.x / cell_px, image.y * mount_.pixel_aspect / cell_px};
                 }
             }});
    return window ? mesh_kernel(pupil, bands, *window) : mesh_kernel(pupil, bands);
}

PointSpread TracedModel::spread(double coc_radius_px, FieldPosition field, Colours colours) const {
    const FieldAxis axis = axis_of(field);
    const Node node = at(field);
    const Fineness fine = fineness(node, outline(node, axis, field, 1e-3), coc_radius_px);
    const auto mapped = [&](PointSpread kernel) {
        if (colours == Colours::Mapped) map_into_gamut(kernel);
        return kernel;
    };
    const int cell = pupil_.has_texture() ? 1 : halo_cell_px(fine.size_px);
    if (cell == 1) return mapped(drawn(coc_radius_px, field, 1, nullptr));
    const PointSpread cells = mapped(drawn(coc_radius_px, field, cell, nullptr));
    const int radius = structure_px(cells, cell);
    if (radius > kMostCore * fine.size_px) return mapped(drawn(coc_radius_px, field, 1, nullptr));
    const Rect window{-radius, -radius, radius + 1, radius + 1};
    PointSpread core = drawn(coc_radius_px, field, 1, &window);
    if (colours == Colours::Mapped) map_part_into_gamut(core);
    return with_halo(core, cells, cell, radius, reach_px(coc_radius_px));
}

PointSpread TracedModel::raw_point_spread(double coc_radius_px, FieldPosition field) const {
    return spread(coc_radius_px, field, Colours::Raw);
}

std::vector<TracedModel::Colour> TracedModel::colours_of(const Node& node, const Fineness& fine,
                                                         double coc_radius_px) const {
    std::vector<Colour> colours;
    const int wavelengths = choice_.wavelengths > 0 ? fine.bands : kLeastWavelengths;
    for (const BandGroup& group : band_groups(fine.bands, wavelengths, choice_.light)) {
        Displacement px;
        for (std::size_t i = 0; i < group.bands.size(); ++i)
            px.add(group.say[i], landing(map_at(node, group.bands[i].wavelength_nm), coc_radius_px));
        colours.push_back({{group.sum.r, group.sum.g, group.sum.b}, px});
    }
    return colours;
}

// A lens of round surfaces is rotationally symmetric on the axis: one ray per zone is enough.
std::optional<std::vector<Rgba>> TracedModel::axial_row(double coc_radius_px, RingColours colours) const {
    if (has_cylinders_ || !pupil_.is_disc({}) || pupil_.has_texture() || mount_.pixel_aspect != 1)
        return std::nullopt;
    const Node node = at({});
    const std::vector<Point> outline_there = outline(node, FieldAxis({}), {}, 1e-3);
    double rim = 0;
    for (const Point& p : outline_there) rim += std::hypot(p.x, p.y) / double(outline_there.size());
    const auto on_pupil = [rim](double area) { return PupilPowers({rim * std::sqrt(area), 0}); };
    std::vector<RingBand> bands;
    double reach_px = 0;
    constexpr int kProbes = 256;
    const RayMap middle = map_at(node, kMiddle_nm);
    for (const auto& [weight, px] :
         colours_of(node, fineness(node, outline_there, coc_radius_px), coc_radius_px)) {
        const auto landing = [on_pupil, px = px](double area) { return px.at(on_pupil(area)).x; };
        for (int i = 0; i <= kProbes; ++i)
            reach_px = std::max(reach_px, std::abs(landing(double(i) / kProbes)));
        bands.push_back({weight, at_each(landing),
                         [on_pupil, &middle](double area) { return light_at(middle, on_pupil(area)); }});
    }
    return ring_row(bands, reach_px, colours);
}

PointSpread TracedModel::point_spread(double coc_radius_px, FieldPosition field) const {
    return spread(coc_radius_px, field, Colours::Mapped);
}

}  // namespace petzval::kernel
