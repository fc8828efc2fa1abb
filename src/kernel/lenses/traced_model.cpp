#include "kernel/lenses/traced_model.h"

#include "base/cancel.h"
#include "kernel/draw/outline.h"
#include "kernel/draw/ray_set.h"
#include "kernel/lenses/parabola.h"
#include "optics/traced_lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace petzval::kernel {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kNodes = 15;           // field sizes traced, axis and corner included
constexpr int kAcross = 7, kUp = 5;  // fields of a quarter of the picture traced, of a lens with cylinders
constexpr double kUnstatedField_deg = 1;  // for lenses whose source speaks of the axis alone
constexpr int kOutlineCorners = 96;       // of what the rims leave open
// Wavelengths traced; parabolas join three neighbours.
constexpr double kTraced_nm[] = {420, 455, 495, 540, 590, 640, 690};
// The nearer object: its radius, of the pupil's.
constexpr double kNearCoc = 0.2;
// The same with cylinders, whose two pupils stand apart, so that the shape of ovals changes with the
// distance. They are those of an object at infinity, as lamps are, if that is at least as far out of focus.
constexpr double kNearCocOfCylinders = 0.02;
constexpr int kRayBands = 62;
constexpr double kRayWidth =
    1.0 / 256;  // of the window through which rays see the pupil's texture, pupil radii

Error refuse(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

// Middle of the light. Across the field's direction it is 0 in a round lens.
struct Middle {
    Point offset_mm, slope, per_coc;
};

// Moves what a map says of a place by `factor` times a point.
void shift(Displacement& map, double factor, Point by) {
    map.along[0] += factor * by.x;
    if (map.is_skew) map.across_even[0] += factor * by.y;
}

Middle middle_of(const RayMap& map, const OpenStop& open) {
    constexpr int kRings = 8;
    Middle sum;
    double light = 0;
    for (const Point& corner : open.corners)
        for (int j = 0; j < kRings; ++j) {
            const double share = (j + 0.5) / kRings;
            const Point to_corner = corner - open.middle;
            const double reach = std::min(1.0, 1 / std::max(1e-9, std::hypot(corner.x, corner.y)));
            const PupilPowers powers(open.middle + (share * reach) * to_corner);
            const double here = light_at(map, powers) * share * reach * reach *
                                (to_corner.x * to_corner.x + to_corner.y * to_corner.y);
            sum.offset_mm = sum.offset_mm + here * map.offset_mm.at(powers);
            sum.slope = sum.slope + here * map.slope.at(powers);
            sum.per_coc = sum.per_coc + here * map.per_coc.at(powers);
            light += here;
        }
    const auto mean = [light](Point p) { return light > 0 ? Point{p.x / light, p.y / light} : p; };
    return {mean(sum.offset_mm), mean(sum.slope), mean(sum.per_coc)};
}

// Luminance of the visible spectrum in the 10 nm around a wavelength.
double luminance_at(double wavelength_nm) {
    double sum = 0;
    for (const colour::SpectralBand& band : colour::spectral_bands(60))
        if (std::abs(band.wavelength_nm - wavelength_nm) <= 5) sum += band.luminance;
    return sum;
}

}  // namespace

TracedModel::TracedModel(const LensChoice& choice, const Mount& mount)
    : pupil_(choice, mount),
      choice_(choice),
      mount_(mount),
      added_(choice, mount, mount.camera.focal_length_mm) {}

Result<std::unique_ptr<const GeometricLens>> TracedModel::make(const optics::Prescription& prescription,
                                                               const LensChoice& choice, const Mount& mount) {
    const auto first = optics::first_order(prescription, prescription.primary_um);
    if (!first) return first.error();
    if (!(first->focal_length_mm > 0)) return refuse(prescription.name + " does not form a real image");
    std::unique_ptr<TracedModel> model(new TracedModel(choice, mount));
    const double factor = mount.camera.focal_length_mm / first->focal_length_mm;
    std::ostringstream text;
    text << prescription.name << ", at f/" << mount.camera.f_number;
    if (std::abs(factor - 1) > 1e-6)
        text << ", scaled from " << first->focal_length_mm << " mm to " << mount.camera.focal_length_mm
             << " mm";
    if (!prescription.dispersion_known) text << ", without colour: the dispersion of its glass is not known";
    model->description_ = text.str();
    if (const Status status = model->trace(optics::scaled(prescription, factor)); !status)
        return status.error();
    model->measure();
    return std::unique_ptr<const GeometricLens>(std::move(model));
}

// Rays are kept in millimetres.
std::unique_ptr<const LensModel> TracedModel::on_pixels(const Mount& mount) const {
    auto same = std::make_unique<TracedModel>(*this);
    same->mount_.display_width_px = mount.display_width_px;
    same->mount_.display_height_px = mount.display_height_px;
    same->px_per_mm_ = mount.display_width_px / mount.camera.sensor_width_mm;
    return same;
}

// Blades, rims in front and added aberrations change neither the rays nor the rims of the glass.
std::unique_ptr<const GeometricLens> TracedModel::with(const LensChoice& choice, const Mount& mount) const {
    const TracedModel other(choice, mount);
    if (choice.focus_mode != choice_.focus_mode || choice.focus_shift_mm != choice_.focus_shift_mm ||
        choice.lateral_colour != choice_.lateral_colour || other.added_.has_colour() != added_.has_colour())
        return nullptr;
    auto same = std::make_unique<TracedModel>(*this);
    same->pupil_ = other.pupil_;
    same->choice_ = choice;
    same->mount_ = mount;
    same->px_per_mm_ = mount.display_width_px / mount.camera.sensor_width_mm;
    same->added_ = other.added_;
    same->reach_offset_mm_ = other.reach_offset_mm_;
    same->reach_per_coc_ = other.reach_per_coc_;
    same->measure();
    return same;
}

Status TracedModel::trace(const optics::Prescription& lens) {
    const Camera& camera = mount_.camera;
    has_cylinders_ = !optics::is_round(lens);
    px_per_mm_ = mount_.display_width_px / camera.sensor_width_mm;
    if (lens.dispersion_known || added_.has_colour())
        wavelength_nm_.assign(std::begin(kTraced_nm), std::end(kTraced_nm));
    else
        wavelength_nm_ = {lens.primary_um * 1000};

    optics::LensSetting setting{camera.f_number,
                                camera.focus_distance_m > 0 ? camera.focus_distance_m * 1000
                                                            : std::numeric_limits<double>::infinity(),
                                0};
    // The open aperture of a lens is often a rounded number: half a percent counts as the lens itself.
    const auto first = optics::first_order(lens, lens.primary_um);
    if (!first) return first.error();
    if (setting.f_number < first->f_number && setting.f_number > 0.99 * first->f_number)
        setting.f_number = first->f_number;
    auto traced = optics::TracedLens::make(lens, setting);
    if (!traced) return traced.error();
    if (choice_.focus_mode != FocusMode::Paraxial) {
        setting.sensor_shift_mm = choice_.focus_shift_mm;
        if (choice_.focus_mode == FocusMode::Best) {
            std::vector<optics::Beam> beams;
            std::vector<double> weights;
            for (const double nm : wavelength_nm_) {
                auto beam = traced->beam(nm / 1000, 0.0);
                if (!beam) return beam.error();
                beams.push_back(std::move(*beam));
                weights.push_back(luminance_at(nm));
            }
            setting.sensor_shift_mm = optics::best_focus_shift_mm(beams, weights);
        }
        traced = optics::TracedLens::make(lens, setting);
        if (!traced) return traced.error();
    }
    image_slope_ = traced->image_side_slope();

    place_near_object(*traced);
    trace_fields(*traced);
    if (nodes_->empty()) return refuse(lens.name + ": no light passes to the middle of the picture");
    return Done{};
}

// A ray from an object at distance z through the rim of an entrance pupil of radius R lands B R (1/F - 1/z)
// from the middle, F the distance in focus and B = R / image_slope, near the axis. That is the signed radius.
void TracedModel::place_near_object(const optics::TracedLens& lens) {
    const double pupil_mm = mount_.camera.focal_length_mm / (2 * lens.f_number());
    const double per_vergence = pupil_mm * pupil_mm / image_slope_;
    const double in_focus = mount_.camera.focus_distance_m > 0 ? 1e-3 / mount_.camera.focus_distance_m : 0;
    coc_at_infinity_mm_ = per_vergence * in_focus;
    // Nothing comes nearer than the front of the lens.
    const double nearest_mm =
        std::max(0.0, lens.first_order().entrance_pupil_position_mm) + 0.5 * mount_.camera.focal_length_mm;
    const double near_coc = has_cylinders_ ? kNearCocOfCylinders : kNearCoc;
    if (has_cylinders_ && coc_at_infinity_mm_ >= near_coc * pupil_mm) {
        near_distance_mm_ = std::numeric_limits<double>::infinity();
        near_coc_mm_ = coc_at_infinity_mm_;
        return;
    }
    const double vergence = std::min(in_focus + near_coc * pupil_mm / per_vergence, 1 / nearest_mm);
    if (!(vergence > in_focus)) return;
    near_distance_mm_ = 1 / vergence;
    near_coc_mm_ = per_vergence * (in_focus - vergence);
}

void TracedModel::trace_fields(const optics::TracedLens& lens) {
    // Heights on the sensor, and the angles at which a pinhole sees them: the input was rendered with one.
    const double aspect = double(mount_.display_height_px) / mount_.display_width_px / mount_.pixel_aspect;
    const double corner =
        0.5 * mount_.camera.sensor_width_mm * std::hypot(1.0, aspect) / mount_.camera.focal_length_mm;
    const double designed_deg = optics::field_angle_deg(lens.prescription(), lens.first_order());
    const double usable_deg = designed_deg > 0 ? designed_deg : kUnstatedField_deg;
    const double designed = std::tan(std::min(usable_deg, 85.0) * kPi / 180);
    largest_field_ = std::min(1.0, designed / corner);
    nodes_ = std::make_shared<Nodes>(has_cylinders_ ? nodes_of_quarter(lens, corner)
                                                    : nodes_along_diagonal(lens, corner));
    if (largest_field_ < 0.99) {
        std::ostringstream text;
        text << "; designed for " << std::atan(largest_field_ * corner) * 180 / kPi
             << " degrees off the axis; farther out, discs are as at that angle";
        description_ += text.str();
    }
}

TracedModel::Nodes TracedModel::nodes_along_diagonal(const optics::TracedLens& lens, double corner) {
    Nodes nodes;
    for (int i = 0; i < kNodes; ++i) {
        const double size = largest_field_ * i / (kNodes - 1);
        std::optional<Node> node = traced_node(lens, lens.in_focus(std::atan(size * corner)));
        if (!node) break;
        nodes.push_back(std::move(*node));
    }
    node_step_ = largest_field_ / (kNodes - 1);
    if (!nodes.empty()) largest_field_ = node_step_ * double(nodes.size() - 1);
    return nodes;
}

// The field of the picture's corner above and to the right of the middle, half the diagonal long.
FieldPosition TracedModel::corner_field() const {
    const double aspect = double(mount_.display_height_px) / mount_.display_width_px / mount_.pixel_aspect;
    const double diagonal = std::hypot(1.0, aspect);
    return {1 / diagonal, aspect / diagonal};
}

// A node beyond the field that the lens was designed for, or where no light passes, is the next one farther
// in.
TracedModel::Nodes TracedModel::nodes_of_quarter(const optics::TracedLens& lens, double corner) const {
    const FieldPosition farthest = corner_field();
    Nodes nodes;
    for (int j = 0; j < kUp; ++j)
        for (int i = 0; i < kAcross; ++i) {
            const double x = farthest.x * i / (kAcross - 1), y = farthest.y * j / (kUp - 1);
            const double size = std::min(std::hypot(x, y), largest_field_);
            // Light that lands above and to the right in the picture, which is turned by 180 degrees, goes
            // up and to the left.
            std::optional<Node> node =
                traced_node(lens, lens.in_focus(std::atan(size * corner), std::atan2(-x, y)));
            if (!node && nodes.empty()) return nodes;
            if (!node) node = i > 0 ? nodes.back() : nodes[nodes.size() - kAcross];
            nodes.push_back(std::move(*node));
        }
    return nodes;
}

std::optional<TracedModel::Node> TracedModel::traced_node(const optics::TracedLens& lens,
                                                          const optics::ObjectPoint& object) const {
    const auto primary = lens.beam(lens.prescription().primary_um, object);
    if (!primary) return std::nullopt;
    const OpenStop open = OpenStop::of(*primary, kOutlineCorners);
    if (open.corners.empty()) return std::nullopt;
    const RayMapFitter fitter(*primary, open);
    if (!fitter.usable()) return std::nullopt;
    Node node{{}, open.corners};
    std::vector<RayMap> all{fitter.fit(*primary)};
    for (const double nm : wavelength_nm_) {
        check_cancelled();
        const auto beam = lens.beam(nm / 1000, object);
        if (!beam) return std::nullopt;
        all.push_back(fitter.fit(*beam));
    }
    const auto per_coc = traced_per_coc(lens, object, fitter, all);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].per_coc = per_coc[i];
    const Middle of_primary = middle_of(all[0], open);
    for (std::size_t i = 1; i < all.size(); ++i) {
        RayMap& map = node.maps.emplace_back(all[i]);
        if (choice_.lateral_colour == 1) continue;
        const Middle here = middle_of(map, open);
        const double more = choice_.lateral_colour - 1;
        shift(map.offset_mm, more, here.offset_mm - of_primary.offset_mm);
        shift(map.slope, more, here.slope - of_primary.slope);
        shift(map.per_coc, more, here.per_coc - of_primary.per_coc);
    }
    return node;
}

// Displacements of the primary wavelength and of the traced ones. They hardly change with colour: three are
// enough.
std::vector<Displacement> TracedModel::traced_per_coc(const optics::TracedLens& lens,
                                                      optics::ObjectPoint object, const RayMapFitter& fitter,
                                                      const std::vector<RayMap>& maps) const {
    std::vector<Displacement> result(maps.size());
    for (std::size_t i = 0; i < maps.size(); ++i) result[i].add(1 / image_slope_, maps[i].slope);
    object.distance_mm = near_distance_mm_;
    const double primary_nm = 1000 * lens.prescription().primary_um;
    if (near_coc_mm_ == 0) return result;  // as on a sensor that moves
    const auto primary = lens.beam(primary_nm / 1000, object);
    if (!primary) return result;
    const optics::SensorRay chief = primary->ray(0, 0);
    if (!chief.reached) return result;
    const auto traced = [&](const optics::Beam& beam, const RayMap& in_focus) {
        Displacement added = fitter.landing(beam, chief, near_coc_mm_ / image_slope_);
        added.add(-1, in_focus.offset_mm);
        return Displacement{}.add(1 / near_coc_mm_, added);
    };
    std::vector<double> few_nm;
    std::vector<Displacement> few;
    for (std::size_t i = 0; i < wavelength_nm_.size();
         i += std::max<std::size_t>(1, wavelength_nm_.size() / 2)) {
        const auto beam = lens.beam(wavelength_nm_[i] / 1000, object);
        if (!beam) return result;
        few_nm.push_back(wavelength_nm_[i]);
        few.push_back(traced(*beam, maps[i + 1]));
    }
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Parabola parabola(few_nm, i == 0 ? primary_nm : wavelength_nm_[i - 1]);
        result[i] = {};
        for (std::size_t k = 0; k < std::min<std::size_t>(3, few.size()); ++k)
            result[i].add(parabola.weight[k], few[parabola.first + k]);
    }
    return result;
}

void TracedModel::measure() {
    for (const Node& node : *nodes_)
        for (const RayMap& map : node.maps)
            for (const Point& corner : node.open) {
                const PupilPowers powers((1 / std::max(1.0, std::hypot(corner.x, corner.y))) * corner);
                const Point offset = map.offset_mm.at(powers), slope = map.slope.at(powers);
                const Point per_coc = map.per_coc.at(powers);
                reach_offset_mm_ = std::max(reach_offset_mm_, std::hypot(offset.x, offset.y));
                reach_per_coc_ = std::max({reach_per_coc_, std::hypot(slope.x, slope.y) / image_slope_,
                                           std::hypot(per_coc.x, per_coc.y)});
            }
    reach_offset_mm_ += added_.reach();
}

std::size_t TracedModel::rays_bytes() const {
    std::size_t bytes = nodes_->capacity() * sizeof(Node);
    for (const Node& node : *nodes_)
        bytes += node.maps.capacity() * sizeof(RayMap) + node.open.capacity() * sizeof(Point);
    return bytes;
}

double TracedModel::reach_px(double coc_radius_px) const {
    const double reach = px_per_mm_ * reach_offset_mm_ + reach_per_coc_ * std::abs(coc_radius_px);
    return reach * std::max(1.0, mount_.pixel_aspect);
}

TracedModel::Node TracedModel::at(FieldPosition field) const {
    Node node = has_cylinders_ ? quarter_at(field) : round_at(std::hypot(field.x, field.y));
    if (added_.any()) add_aberrations(node, field);
    return node;
}

void TracedModel::add_aberrations(Node& node, FieldPosition field) const {
    const double size = std::hypot(field.x, field.y);
    Point outward{1, 0};
    if (has_cylinders_ && size > 0) outward = {std::abs(field.y) / size, std::abs(field.x) / size};
    for (std::size_t w = 0; w < node.maps.size(); ++w)
        node.maps[w].offset_mm.add(1, added_.polynomial(size, colour_place(wavelength_nm_[w]), outward));
}

TracedModel::Node TracedModel::quarter_at(FieldPosition field) const {
    const FieldPosition farthest = corner_field();
    const auto place = [](double at, double end, int count) {
        return std::min(std::abs(at) / end, 1.0) * (count - 1);
    };
    const double x = place(field.x, farthest.x, kAcross), y = place(field.y, farthest.y, kUp);
    const int i = std::min(int(x), kAcross - 2), j = std::min(int(y), kUp - 2);
    const double s = x - i, t = y - j;
    const double weights[] = {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
    Node sum;
    for (int k = 0; k < 4; ++k) {
        const Node& node = (*nodes_)[std::size_t((j + k / 2) * kAcross + i + k % 2)];
        sum.maps.resize(node.maps.size());
        sum.open.resize(node.open.size());
        for (std::size_t w = 0; w < node.maps.size(); ++w) sum.maps[w].add(weights[k], node.maps[w]);
        for (std::size_t c = 0; c < node.open.size(); ++c)
            sum.open[c] = sum.open[c] + weights[k] * node.open[c];
    }
    return sum;
}

TracedModel::Node TracedModel::round_at(double field_size) const {
    const Nodes& nodes = *nodes_;
    const double place = node_step_ > 0 ? std::min(field_size, largest_field_) / node_step_ : 0;
    const std::size_t i = std::min(std::size_t(place), nodes.size() - 1),
                      k = std::min(i + 1, nodes.size() - 1);
    const double t = place - double(i);
    Node node = nodes[i];
    for (std::size_t w = 0; w < node.maps.size(); ++w) {
        node.maps[w].add(-t, nodes[i].maps[w]);
        node.maps[w].add(t, nodes[k].maps[w]);
    }
    for (std::size_t c = 0; c < node.open.size(); ++c)
        node.open[c] = node.open[c] + t * (nodes[k].open[c] - node.open[c]);
    return node;
}

RayMap TracedModel::map_at(const Node& node, double wavelength_nm) const {
    const Parabola parabola(wavelength_nm_, wavelength_nm);
    RayMap map;
    for (std::size_t i = 0; i < std::min<std::size_t>(3, node.maps.size()); ++i)
        map.add(parabola.weight[i], node.maps[parabola.first + i]);
    return map;
}

Displacement TracedModel::landing(const RayMap& map, double coc_radius_px) const {
    Displacement px;
    px.add(px_per_mm_, map.offset_mm);
    // A sensor that moves would not draw the ovals of objects.
    if (has_cylinders_) return px.add(coc_radius_px, map.per_coc);
    const double of_objects_px = std::min(coc_radius_px, px_per_mm_ * coc_at_infinity_mm_);
    px.add(of_objects_px, map.per_coc);
    px.add((coc_radius_px - of_objects_px) / image_slope_, map.slope);
    return px;
}

std::vector<Point> TracedModel::outline(const Node& node, const FieldAxis& axis, FieldPosition field,
                                        double tolerance) const {
    std::vector<Point> iris = pupil_.outline(field, tolerance);
    axis.to_axis(iris);
    std::vector<Point> seen = clipped(iris, node.open);
    // Blades and rims may leave nothing between them; then the rims alone decide.
    if (seen.size() < 3 || area(seen) < 1e-4) seen = clipped(node.open, Circle{}, tolerance);
    return seen.size() < 3 ? iris : seen;
}

std::vector<Point> TracedModel::pupil_outline(FieldPosition field, double tolerance) const {
    const FieldAxis axis = axis_of(field);
    std::vector<Point> seen = outline(at(field), axis, field, tolerance);
    axis.from_axis(seen);
    return seen;
}

std::function<Point(Point)> TracedModel::landing(double wavelength_nm, double coc_radius_px,
                                                 FieldPosition field) const {
    const FieldAxis axis = axis_of(field);
    const Displacement px = landing(map_at(at(field), wavelength_nm), coc_radius_px);
    return [px, axis, aspect = mount_.pixel_aspect](Point pupil) {
        const Point image = axis.from_axis(px.at(PupilPowers(axis.to_axis(pupil))));
        return Point{image.x, image.y * aspect};
    };
}

std::vector<PupilRay> TracedModel::rays(int count, FieldPosition field, std::uint64_t seed) const {
    const FieldAxis axis = axis_of(field);
    const Node node = at(field);
    const auto bands = colour::spectral_bands(wavelength_nm_.size() < 3 ? 1 : kRayBands, choice_.light);
    std::vector<RayMap> maps;
    for (const colour::SpectralBand& band : bands) maps.push_back(map_at(node, band.wavelength_nm));
    const auto picture = [&](Point p) {
        const Point image = axis.from_axis(p);
        return Point{image.x, image.y * mount_.pixel_aspect};
    };
    return spread_rays(outline(node, axis, field, 1e-4), bands, count, seed,
                       [&](std::size_t band, Point pupil) {
                           const PupilPowers powers(pupil);
                           const double passed = pupil_.transmission(axis.from_axis(pupil), kRayWidth);
                           return RayLanding{picture(maps[band].per_coc.at(powers)),
                                             picture(px_per_mm_ * maps[band].offset_mm.at(powers)),
                                             light_at(maps[band], powers) * passed};
                       });
}

}  // namespace petzval::kernel
