// A lens given by its prescription, as engines use it.
//
// Rays are traced for a row of field positions and wavelengths from the axis to the corner of the picture;
// between them, and over the stop, polynomials stand for them. They come from the plane in focus and from an
// object in front of it, at the distance of a signed CoC radius of a fifth of the pupil's: what light does
// that is out of focus is linear in the radius, as rays run straight in front of a lens. Beyond the radius of
// infinity, where no object can be, the sensor moves: by (what is beyond) / (slope of the marginal ray).
// Vignetting comes from the clear apertures of all surfaces. Kernels are centred on the chief ray of the
// primary wavelength, so lateral colour shows and distortion does not move the picture.
//
// A lens with cylinders is traced for a grid of fields in a quarter of the picture, which the others mirror.
// Its picture is shown at its full width (TracedLens::squeeze()), so its discs are ovals.
#pragma once

#include "colour/spectrum.h"
#include "kernel/draw/mesh_kernel.h"
#include "kernel/draw/pupil.h"
#include "kernel/draw/ray_map.h"
#include "kernel/lenses/field_axis.h"
#include "kernel/lenses/geometric_lens.h"
#include "kernel/lenses/third_order.h"
#include "optics/traced_lens.h"

#include <optional>

namespace petzval::kernel {

class TracedModel final : public GeometricLens {
public:
    // The lens is scaled to the camera's focal length.
    // Errors: InvalidArgument for an aperture wider than the lens has, a focus distance too near for it,
    // glass without known dispersion limits; those of optics::TracedLens.
    static Result<std::unique_ptr<const GeometricLens>> make(const optics::Prescription& prescription,
                                                             const LensChoice& choice, const Mount& mount);

    std::unique_ptr<const LensModel> on_pixels(const Mount& mount) const override;
    std::unique_ptr<const GeometricLens> with(const LensChoice& choice, const Mount& mount) const override;
    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override;
    PointSpread raw_point_spread(double coc_radius_px, FieldPosition field) const override;
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override;
    double reach_px(double coc_radius_px) const override;
    bool varies_over_field() const override { return true; }
    bool is_round() const override { return !has_cylinders_; }
    Mirrors mirrors() const override { return pupil_.mirrors(); }
    std::vector<Point> pupil_outline(FieldPosition field, double tolerance) const override;
    std::function<Point(Point)> landing(double wavelength_nm, double coc_radius_px,
                                        FieldPosition field) const override;
    double pupil_transmission(Point pupil, double half_width) const override {
        return pupil_.transmission(pupil, half_width);
    }
    std::optional<std::vector<Rgba>> axial_row(double coc_radius_px, RingColours colours) const override;
    std::string description() const override { return description_; }
    std::size_t rays_bytes() const override;

private:
    struct Node {                  // one field size; with cylinders, one field of a quarter of the picture
        std::vector<RayMap> maps;  // by wavelength
        std::vector<Point> open;   // of the stop, (along, across)
    };
    using Nodes = std::vector<Node>;
    TracedModel(const LensChoice& choice, const Mount& mount);
    Status trace(const optics::Prescription& lens);
    void place_near_object(const optics::TracedLens& lens);
    void trace_fields(const optics::TracedLens& lens);
    Nodes nodes_along_diagonal(const optics::TracedLens& lens, double corner);
    Nodes nodes_of_quarter(const optics::TracedLens& lens, double corner) const;
    FieldPosition corner_field() const;
    FieldAxis axis_of(FieldPosition field) const {
        return has_cylinders_ ? FieldAxis::upright(field) : FieldAxis(field);
    }
    void measure();
    Node at(FieldPosition field) const;
    Node round_at(double field_size) const;
    Node quarter_at(FieldPosition field) const;
    void add_aberrations(Node& node, FieldPosition field) const;
    RayMap map_at(const Node& node, double wavelength_nm) const;
    Displacement landing(const RayMap& map, double coc_radius_px) const;
    std::vector<Point> outline(const Node& node, const FieldAxis& axis, FieldPosition field,
                               double tolerance) const;
    struct Fineness {
        double size_px = 0;  // how far light lands
        double path_px = 0;  // that rims travel over wavelengths that count
        int bands = 1;
    };
    int bands_for(double path_px) const;
    Fineness fineness(const Node& node, const std::vector<Point>& outline, double coc_radius_px) const;
    struct Colour {
        Light weight;
        Displacement landing_px;
    };
    enum class Colours { Raw, Mapped };
    PointSpread spread(double coc_radius_px, FieldPosition field, Colours colours) const;
    PointSpread drawn(double coc_radius_px, FieldPosition field, double cell_px, const Rect* window) const;
    std::vector<Colour> colours_of(const Node& node, const Fineness& fine, double coc_radius_px) const;
    std::optional<Node> traced_node(const optics::TracedLens& lens, const optics::ObjectPoint& object) const;
    std::vector<Displacement> traced_per_coc(const optics::TracedLens& lens, optics::ObjectPoint object,
                                             const RayMapFitter& fitter,
                                             const std::vector<RayMap>& maps) const;

    std::string description_;
    Pupil pupil_;
    LensChoice choice_;
    Mount mount_;
    double px_per_mm_ = 0, image_slope_ = 1;
    ThirdOrder added_;  // mm
    double near_distance_mm_ = 0,
           near_coc_mm_ = 0;  // of the object out of focus, its radius on the sensor; 0: none
    double coc_at_infinity_mm_ = 0;
    std::vector<double> wavelength_nm_;
    bool has_cylinders_ = false;
    // Even steps of field size, from 0; with cylinders, even steps of both coordinates, row by row. Copies
    // share them.
    std::shared_ptr<const Nodes> nodes_ = std::make_shared<Nodes>();
    double node_step_ = 0;
    double largest_field_ = 0;  // of the last node; beyond it, the lens is as there
    double reach_offset_mm_ = 0, reach_per_coc_ = 1;
};

}  // namespace petzval::kernel
