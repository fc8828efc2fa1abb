#include "c/files/lent_shot.h"

#include "petzval/names.h"

namespace petzval::c {
namespace {

static_assert(sizeof(DeepSample) == sizeof(petzval_deep_sample) && sizeof(std::size_t) == sizeof(uint64_t));

// C has no constant pictures; a host only reads these.
template <typename T>
void* address(const T* data) {
    return const_cast<T*>(data);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

petzval_plane plane_of(View<const float> view) {
    return {sizeof(petzval_plane),
            view.width(),
            view.height(),
            PETZVAL_FLOAT,
            address(view.row(0)),
            sizeof(float),
            std::ptrdiff_t(view.row_stride() * sizeof(float))};
}

// Null where there are no samples.
const petzval_deep* lend(const DeepPicture& from, petzval_deep& into) {
    if (from.empty()) return nullptr;
    // Six floats in the same order.
    const auto* samples = reinterpret_cast<const petzval_deep_sample*>(from.samples().data());  // NOLINT
    into = {sizeof into, from.width(), from.height(), from.first().data(), samples, from.sample_count()};
    return &into;
}

petzval_rect rect_of(const Rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

petzval_camera camera_of(const Camera& c) {
    return {sizeof(petzval_camera), c.focal_length_mm,
            c.sensor_width_mm,      c.f_number,
            c.focus_distance_m,     c.image_scale == ImageScale::ThinLens ? 1 : 0};
}

}  // namespace

petzval_pixels pixels_of(const Picture& picture) {
    auto* first = static_cast<float*>(address(&picture.pixels()->r));
    return {sizeof(petzval_pixels),
            picture.width(),
            picture.height(),
            PETZVAL_FLOAT,
            first,
            first + 1,
            first + 2,
            first + 3,
            sizeof(Rgba),
            std::ptrdiff_t(sizeof(Rgba)) * picture.width()};
}

void LentShot::fill(const Shot& from) {
    shot.size = sizeof shot;
    colour = pixels_of(from.colour);
    shot.colour = &colour;
    if (!from.depth_plane().empty()) {
        depth = plane_of(from.depth_plane());
        (from.has_radii() ? shot.radii_px : shot.depth_m) = &depth;
    }
    camera = camera_of(known_camera(from.camera, from.image_scale));
    shot.camera = &camera;
    shot.display_window = rect_of(from.place.display_window),
    shot.data_window = rect_of(from.place.data_window);
    shot.pixel_aspect = from.place.pixel_aspect;
    shot.deep = lend(from.deep, deep), shot.behind = lend(from.behind, behind);
    shot.holdout = lend(from.holdout, holdout);
    if (!from.mask.empty()) {
        mask = plane_of(
            from.mask.view().part(from.place.data_window.moved(-from.mask_window.x0, -from.mask_window.y0)));
        shot.mask = &mask;
    }
    for (const LightPoint& l : from.lights)
        lights.push_back({l.x, l.y, l.r, l.g, l.b, l.depth_m, l.coc_px, l.diameter_px});
    shot.lights = lights.data(), shot.light_count = lights.size();
    for (const FrameLayer& layer : from.layers) layer_colours.push_back(pixels_of(layer.colour));
    for (std::size_t i = 0; i < from.layers.size(); ++i)
        layers.push_back({sizeof(petzval_layer), &layer_colours[i], from.layers[i].is_light ? 0 : 1,
                          from.layers[i].spectrum ? name_of(*from.layers[i].spectrum) : nullptr, nullptr});
    for (const petzval_layer& layer : layers) layer_pointers.push_back(&layer);
    shot.layers = layer_pointers.data(), shot.layer_count = layer_pointers.size();
}

}  // namespace petzval::c
