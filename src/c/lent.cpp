#include "c/lent.h"

#include "petzval/names.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace petzval::c {
namespace {

Error refused(const std::string& why) { return {ErrorCode::InvalidArgument, why}; }

constexpr int kLargestSide = 1 << 20;  // pixels; keeps sizes and addresses far from overflow

Status check_size(int width, int height, const char* name) {
    if (width > 0 && height > 0 && width <= kLargestSide && height <= kLargestSide) return Done{};
    return refused(std::string(name) + " is " + std::to_string(width) + "x" + std::to_string(height) +
                   " pixels; 1 to " + std::to_string(kLargestSide) + " a side");
}

SampleType type_of(petzval_sample sample) {
    return sample == PETZVAL_HALF ? SampleType::Half : SampleType::Float;
}

// Checks the strides of a host's pixels.
Status check_layout(int width, int height, petzval_sample sample, std::ptrdiff_t pixel_stride,
                    std::ptrdiff_t row_stride, const char* name) {
    if (sample != PETZVAL_FLOAT && sample != PETZVAL_HALF)
        return refused(std::string(name) + ": sample is neither PETZVAL_FLOAT nor PETZVAL_HALF");
    constexpr std::int64_t kFarthest = std::int64_t(1) << 40;  // times a side it is still an address
    const std::ptrdiff_t least = sample == PETZVAL_HALF ? 2 : 4;
    struct Stride {
        const char* called;
        std::ptrdiff_t bytes;
        int count;
    };
    for (const auto& [called, bytes, count] :
         {Stride{"pixel_stride", pixel_stride, width}, Stride{"row_stride", row_stride, height}})
        if (count > 1 && (bytes > kFarthest || bytes < -kFarthest || (bytes < least && bytes > -least)))
            return refused(std::string(name) + ": " + called + " is " + std::to_string(bytes) +
                           " bytes; samples of " + std::to_string(least) +
                           " bytes lie at least so far apart");
    return Done{};
}

Rect rect_of(const petzval_rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

Status check_deep(const petzval_deep* given, const ColourView& colour, const char* name) {
    if (!given) return Done{};
    const petzval_deep deep = taken(given);
    if (deep.width != colour.width || deep.height != colour.height)
        return refused(std::string(name) + " is not of the size of colour");
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
    if (!place.fits(colour.width, colour.height)) return refused("data_window is not of the picture's size");
    return place;
}

Result<ComparedLayer> compared_layer(const petzval_layer* given, const ColourView& colour,
                                     const std::string& name) {
    if (!given) return refused(name + " is null");
    const petzval_layer layer = taken(given);
    ComparedLayer compared;
    auto view = colour_view(layer.colour, name.c_str());
    if (!view) return view.error();
    if (view->width != colour.width || view->height != colour.height)
        return refused(name + " is not of the size of colour");
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
        return refused("layer_count is " + std::to_string(shot.layer_count) + "; 0 to " +
                       std::to_string(kMost) + ", with layers");
    std::vector<ComparedLayer> layers;
    for (std::uint64_t i = 0; i < shot.layer_count; ++i) {
        auto layer = compared_layer(shot.layers[i], colour, "layers[" + std::to_string(i) + "]");
        if (!layer) return layer.error();
        layers.push_back(*layer);
    }
    return layers;
}

// A host's functions behind our interface.
class LentWorkers final : public Workers {
public:
    explicit LentWorkers(const petzval_workers& lent)
        : lent_(lent), width_(std::max(1, lent.width(lent.host))) {}
    int width() const override { return width_; }
    void run(int count, FunctionRef<void(int)> body) override {
        lent_.run(
            lent_.host, count,
            [](void* context, int index) { (*static_cast<FunctionRef<void(int)>*>(context))(index); }, &body);
    }

private:
    petzval_workers lent_;
    int width_;
};

}  // namespace

Camera camera_of(const petzval_camera& c) {
    return {.focal_length_mm = c.focal_length_mm,
            .sensor_width_mm = c.sensor_width_mm,
            .f_number = c.f_number,
            .focus_distance_m = c.focus_distance_m,
            .image_scale = c.thin_lens != 0 ? ImageScale::ThinLens : ImageScale::Rendered};
}

Result<std::shared_ptr<Workers>> workers_of(const petzval_workers* given) {
    if (!given) return std::shared_ptr<Workers>();
    const petzval_workers lent = taken(given);
    if (!lent.width || !lent.run) return refused("workers: width or run is null");
    return std::shared_ptr<Workers>(std::make_shared<LentWorkers>(lent));
}

Result<SessionSettings> session_settings_of(const petzval_session_settings* given) {
    constexpr int kMostThreads = 1024;
    const petzval_session_settings s = taken(given);
    if (s.threads < 0 || s.threads > kMostThreads)
        return Error{ErrorCode::InvalidArgument, "session.threads is " + std::to_string(s.threads) +
                                                     "; 0 (all) to " + std::to_string(kMostThreads)};
    SessionSettings settings;
    settings.threads = s.threads;
    settings.max_memory_bytes = std::size_t(s.max_memory_bytes);
    if (s.kernel_folder) settings.kernel_cache_folder = s.kernel_folder;
    if (s.device) settings.device = s.device;
    auto workers = workers_of(s.workers);
    if (!workers) return workers.error();
    settings.workers = std::move(*workers);
    return settings;
}

Result<ColourView> colour_view(const petzval_pixels* given, const char* name) {
    if (!given) return refused(std::string(name) + " is null");
    const petzval_pixels p = taken(given);
    if (Status ok = check_size(p.width, p.height, name); !ok) return ok.error();
    if (!p.r || !p.g || !p.b) return refused(std::string(name) + ": r, g or b is null");
    if (Status ok = check_layout(p.width, p.height, p.sample, p.pixel_stride, p.row_stride, name); !ok)
        return ok.error();
    ColourView view{p.width, p.height, {}};
    void* const bases[4] = {p.r, p.g, p.b, p.a};
    for (std::size_t c = 0; c < 4; ++c)
        view.channels[c] = {type_of(p.sample), static_cast<std::byte*>(bases[c]), p.pixel_stride,
                            p.row_stride};
    return view;
}

Status check_plane(const petzval_plane* given, int width, int height, const char* name) {
    const petzval_plane p = taken(given);
    if (!p.data) return refused(std::string(name) + ": data is null");
    if (p.width == width && p.height == height)
        return check_layout(width, height, p.sample, p.pixel_stride, p.row_stride, name);
    return refused(std::string(name) + " is " + std::to_string(p.width) + "x" + std::to_string(p.height) +
                   " and colour " + std::to_string(width) + "x" + std::to_string(height) +
                   "; they must be of one size");
}

Plane read_plane(const petzval_plane* given) {
    const petzval_plane plane = taken(given);
    Plane read = Plane::uninitialised(plane.width, plane.height);
    read_pixels(PlaneView{type_of(plane.sample), static_cast<std::byte*>(plane.data), plane.pixel_stride,
                          plane.row_stride},
                read);
    return read;
}

Result<ComparedShot> ComparedShot::compare(const petzval_shot* given) {
    if (!given) return refused("shot is null");
    const petzval_shot shot = taken(given);
    const auto colour = colour_view(shot.colour, "colour");
    if (!colour) return colour.error();
    if ((shot.depth_m != nullptr) == (shot.radii_px != nullptr))
        return refused("shot: one of depth_m and radii_px, and not both");
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
    return ComparedShot{shot, *colour, *place, std::move(*layers)};
}

Status TakenShot::take(const ComparedShot& compared, TakenShot& into) {
    const petzval_shot& shot = compared.given;
    into.colour = Picture::uninitialised(compared.colour.width, compared.colour.height);
    read_pixels(compared.colour, into.colour);
    into.rendered.colour = into.colour;
    into.depth = read_plane(shot.radii_px ? shot.radii_px : shot.depth_m);
    if (shot.radii_px)
        into.rendered.depth = SignedRadii{into.depth};
    else
        into.rendered.depth = PlanarDepth{into.depth};
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
