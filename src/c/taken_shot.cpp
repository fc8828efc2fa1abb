// A host's shot: compared first, then read into our pictures.
#include "petzval/names.h"

#include "c/lent.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace petzval::c {
namespace {

Rect rect_of(const petzval_rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

Status check_deep(const petzval_deep* given, const ColourView& colour, const char* name) {
    if (!given) return Done{};
    const petzval_deep deep = taken(given);
    if (deep.width != colour.width || deep.height != colour.height)
        return refused(std::string(name) + " must have the size of colour");
    if (!deep.first || (!deep.samples && deep.sample_count > 0))
        return refused(std::string(name) + ": first or samples is null");
    constexpr std::uint64_t kMost = std::uint64_t(1) << 36;  // more than memory holds
    if (deep.sample_count <= kMost) return Done{};
    return refused(std::string(name) + ": sample_count is " + std::to_string(deep.sample_count) +
                   "; at most " + std::to_string(kMost));
}

Status check_lights(const petzval_shot& shot) {
    constexpr std::uint64_t kMost = std::uint64_t(1) << 28;
    if (shot.light_count > kMost)
        return refused("light_count is " + std::to_string(shot.light_count) + "; at most " +
                       std::to_string(kMost));
    return shot.light_count > 0 && !shot.lights ? Status(refused("lights is null")) : Done{};
}

// Samples are read once, so that a host that changes them meanwhile breaks nothing.
Status take_deep(const petzval_deep* given, const char* name, DeepPicture& into) {
    const petzval_deep deep = taken(given);
    const std::size_t pixels = std::size_t(deep.width) * std::size_t(deep.height);
    std::vector<std::size_t> first(deep.first, deep.first + pixels + 1);
    if (first.front() != 0 || first.back() != deep.sample_count ||
        !std::is_sorted(first.begin(), first.end()))
        return refused(std::string(name) + ": first must rise from 0 to sample_count");
    std::vector<DeepSample> samples;
    samples.reserve(first.back());
    for (std::size_t i = 0; i < first.back(); ++i) {
        const petzval_deep_sample& s = deep.samples[i];
        samples.push_back({{s.r, s.g, s.b, s.a}, s.depth, s.depth_back});
    }
    into = DeepPicture(deep.width, deep.height, std::move(first), std::move(samples));
    return Done{};
}

void take_lights(const petzval_shot& shot, TakenShot& into) {
    if (shot.light_count == 0) return;
    for (std::uint64_t i = 0; i < shot.light_count; ++i) {
        const petzval_light& l = shot.lights[i];
        into.lights.push_back({l.x, l.y, l.r, l.g, l.b, l.depth_m, l.radius_px, l.diameter_px});
    }
    into.rendered.lights = &into.lights;
}

// The place of the picture. Errors: InvalidArgument naming the field.
Result<Place> place_of(const petzval_shot& shot, const ColourView& colour) {
    const Rect display = rect_of(shot.display_window), data = rect_of(shot.data_window);
    Place place;
    place.data_window = data.empty() ? Rect{0, 0, colour.width, colour.height} : data;
    place.display_window = display.empty() ? place.data_window : display;
    if (shot.pixel_aspect != 0) place.pixel_aspect = shot.pixel_aspect;
    if (Status ok = check(place); !ok) return ok.error();
    if (!place.fits(colour.width, colour.height)) return refused("data_window must have the picture's size");
    return place;
}

// Errors: InvalidArgument naming the field; those of depth_to_planar_metres() come when depth is read.
Result<std::optional<DepthSettings>> meaning_of(const petzval_shot& shot) {
    if (!shot.depth_meaning) return std::optional<DepthSettings>();
    if (!shot.depth_m) return refused("depth_meaning is for depth_m; radii_px are radii in pixels");
    const petzval_depth_meaning meaning = taken(shot.depth_meaning);
    DepthSettings settings;
    if (meaning.kind) {
        const auto kind = parse<DepthKind>(meaning.kind);
        if (!kind) return refused("depth_meaning.kind is " + kind.error().message);
        settings.kind = *kind;
    }
    if (meaning.unit_m != 0) settings.unit_scale_m = meaning.unit_m;
    if (meaning.range) settings.range_near = meaning.range[0], settings.range_far = meaning.range[1];
    if (!shot.camera) return std::optional(settings);
    const petzval_camera camera = taken(shot.camera);
    if (camera.focal_length_mm != 0) settings.focal_length_mm = camera.focal_length_mm;
    if (camera.sensor_width_mm != 0) settings.sensor_width_mm = camera.sensor_width_mm;
    return std::optional(settings);
}

// Depth as rendered becomes planar metres or radii.
Status take_depth(const ComparedShot& compared, TakenShot& into) {
    const petzval_shot& shot = compared.given;
    into.depth = read_plane(shot.radii_px ? shot.radii_px : shot.depth_m);
    const bool radii = shot.radii_px || (compared.meaning && compared.meaning->kind == DepthKind::CocPx);
    if (compared.meaning) {
        const DepthSettings& settings = *compared.meaning;
        join_depth_codes(into.depth, settings, false);
        auto report = radii ? depth_to_radii_px(into.depth.view(), settings)
                            : depth_to_planar_metres(into.depth.view(), compared.place, settings);
        if (!report) return report.error();
        into.warnings = std::move(report->warnings);
    }
    if (radii)
        into.rendered.depth = SignedRadii{into.depth};
    else
        into.rendered.depth = PlanarDepth{into.depth};
    return Done{};
}

Result<ComparedLayer> compared_layer(const petzval_layer* given, const ColourView& colour,
                                     const std::string& name) {
    if (!given) return refused(name + " is null");
    const petzval_layer layer = taken(given);
    ComparedLayer compared;
    auto view = colour_view(layer.colour, name.c_str());
    if (!view) return view.error();
    if (view->width != colour.width || view->height != colour.height)
        return refused(name + " must have the size of colour");
    compared.colour = *view;
    compared.is_light = layer.is_matte == 0;
    if (layer.spectrum) {
        const auto spectrum = parse<LightSpectrum>(layer.spectrum);
        if (!spectrum) return refused(name + ".spectrum is " + spectrum.error().message);
        compared.spectrum = *spectrum;
    }
    if (!layer.out) return compared;
    view = colour_view(layer.out, (name + ".out").c_str());
    if (!view) return view.error();
    compared.out = *view;
    return compared;
}

Result<std::vector<ComparedLayer>> compared_layers(const petzval_shot& shot, const ColourView& colour) {
    constexpr std::uint64_t kMost = 1024;
    if (shot.layer_count > kMost || (shot.layer_count > 0 && !shot.layers))
        return refused("layer_count is " + std::to_string(shot.layer_count) + "; it must be 0 to " +
                       std::to_string(kMost) + ", and layers must not be null");
    std::vector<ComparedLayer> layers;
    for (std::uint64_t i = 0; i < shot.layer_count; ++i) {
        auto layer = compared_layer(shot.layers[i], colour, "layers[" + std::to_string(i) + "]");
        if (!layer) return layer.error();
        layers.push_back(*layer);
    }
    return layers;
}

}  // namespace

Result<ComparedShot> ComparedShot::compare(const petzval_shot* given) {
    if (!given) return refused("shot is null");
    const petzval_shot shot = taken(given);
    const auto colour = colour_view(shot.colour, "colour");
    if (!colour) return colour.error();
    if ((shot.depth_m != nullptr) == (shot.radii_px != nullptr))
        return refused("shot needs either depth_m or radii_px");
    for (const auto& [plane, name] :
         {std::pair{shot.depth_m, "depth_m"}, {shot.radii_px, "radii_px"}, {shot.mask, "mask"}})
        if (plane)
            if (Status ok = check_plane(plane, colour->width, colour->height, name); !ok) return ok.error();
    for (const auto& [deep, name] :
         {std::pair{shot.deep, "deep"}, {shot.behind, "behind"}, {shot.holdout, "holdout"}})
        if (Status ok = check_deep(deep, *colour, name); !ok) return ok.error();
    if (Status ok = check_lights(shot); !ok) return ok.error();
    auto layers = compared_layers(shot, *colour);
    if (!layers) return layers.error();
    const auto place = place_of(shot, *colour);
    if (!place) return place.error();
    const auto meaning = meaning_of(shot);
    if (!meaning) return meaning.error();
    return ComparedShot{shot, *colour, *place, std::move(*layers), *meaning};
}

Status TakenShot::take(const ComparedShot& compared, TakenShot& into) {
    const petzval_shot& shot = compared.given;
    into.colour = Picture::uninitialised(compared.colour.width, compared.colour.height);
    read_pixels(compared.colour, into.colour);
    into.rendered.colour = into.colour;
    if (Status ok = take_depth(compared, into); !ok) return ok;
    if (shot.mask) into.rendered.mask = into.mask = read_plane(shot.mask);
    into.rendered.place = compared.place;
    if (shot.camera) into.rendered.camera = camera_of(taken(shot.camera));
    struct Deep {
        const petzval_deep* given;
        const char* name;
        DeepPicture& own;
        const DeepPicture*& lent;
    };
    for (const Deep& d : {Deep{shot.deep, "deep", into.deep, into.rendered.deep},
                          Deep{shot.behind, "behind", into.behind, into.rendered.behind},
                          Deep{shot.holdout, "holdout", into.holdout, into.rendered.holdout}}) {
        if (!d.given) continue;
        if (Status ok = take_deep(d.given, d.name, d.own); !ok) return ok;
        d.lent = &d.own;
    }
    take_lights(shot, into);
    for (const ComparedLayer& layer : compared.layers) {
        into.layers.push_back(Picture::uninitialised(compared.colour.width, compared.colour.height));
        read_pixels(layer.colour, into.layers.back());
    }
    for (std::size_t i = 0; i < into.layers.size(); ++i)
        into.rendered.layers.push_back(
            {into.layers[i], compared.layers[i].is_light, compared.layers[i].spectrum});
    return Done{};
}

}  // namespace petzval::c
