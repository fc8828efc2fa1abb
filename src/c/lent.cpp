#include "c/lent.h"

#include <algorithm>
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

Status check_sample(petzval_sample sample, const char* name) {
    if (sample == PETZVAL_FLOAT || sample == PETZVAL_HALF) return Done{};
    return refused(std::string(name) + ": sample is neither PETZVAL_FLOAT nor PETZVAL_HALF");
}

SampleType type_of(petzval_sample sample) {
    return sample == PETZVAL_HALF ? SampleType::Half : SampleType::Float;
}

Rect rect_of(const petzval_rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

Status take_plane(const petzval_plane* given, const TakenShot& shot, const char* name, Plane& into) {
    const int width = shot.colour.width(), height = shot.colour.height();
    if (Status ok = check_plane(given, width, height, name); !ok) return ok;
    const petzval_plane plane = taken(given);
    into = Plane::uninitialised(width, height);
    read_pixels(PlaneView{type_of(plane.sample), static_cast<std::byte*>(plane.data), plane.pixel_stride,
                          plane.row_stride},
                into);
    return Done{};
}

// Depth or radii, whichever was given.
Status take_depth(const petzval_shot& shot, TakenShot& into) {
    if ((shot.depth_m != nullptr) == (shot.radii_px != nullptr))
        return refused("shot: one of depth_m and radii_px, and not both");
    const bool radii = shot.radii_px != nullptr;
    const petzval_plane* const given = radii ? shot.radii_px : shot.depth_m;
    if (Status ok = take_plane(given, into, radii ? "radii_px" : "depth_m", into.depth); !ok) return ok;
    (radii ? into.job.coc_px : into.job.depth_m) = into.depth;
    return Done{};
}

// Samples are read once, so that a host that changes them meanwhile breaks nothing.
Status take_deep(const petzval_deep* given, const TakenShot& shot, const char* name, DeepPicture& into) {
    if (!given) return Done{};
    const petzval_deep deep = taken(given);
    const int width = shot.colour.width(), height = shot.colour.height();
    if (deep.width != width || deep.height != height)
        return refused(std::string(name) + " is not of the size of colour");
    if (!deep.first || (!deep.samples && deep.sample_count > 0))
        return refused(std::string(name) + ": first or samples is null");
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
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
    into = DeepPicture(width, height, std::move(first), std::move(samples));
    return Done{};
}

Status take_lights(const petzval_shot& shot, TakenShot& into) {
    if (shot.light_count == 0) return Done{};
    if (!shot.lights) return refused("lights is null");
    for (std::uint64_t i = 0; i < shot.light_count; ++i) {
        const petzval_light& l = shot.lights[i];
        into.lights.push_back({l.x, l.y, l.r, l.g, l.b, l.depth_m, l.radius_px, l.diameter_px});
    }
    into.job.points = &into.lights;
    return Done{};
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

Result<ColourView> colour_view(const petzval_pixels* given, const char* name) {
    if (!given) return refused(std::string(name) + " is null");
    const petzval_pixels p = taken(given);
    if (Status ok = check_size(p.width, p.height, name); !ok) return ok.error();
    if (Status ok = check_sample(p.sample, name); !ok) return ok.error();
    if (!p.r || !p.g || !p.b) return refused(std::string(name) + ": r, g or b is null");
    ColourView view{p.width, p.height, {}};
    void* const bases[4] = {p.r, p.g, p.b, p.a};
    for (std::size_t c = 0; c < 4; ++c)
        view.channels[c] = {type_of(p.sample), static_cast<std::byte*>(bases[c]), p.pixel_stride,
                            p.row_stride};
    return view;
}

Status check_plane(const petzval_plane* given, int width, int height, const char* name) {
    const petzval_plane p = taken(given);
    if (Status ok = check_sample(p.sample, name); !ok) return ok;
    if (!p.data) return refused(std::string(name) + ": data is null");
    if (p.width == width && p.height == height) return Done{};
    return refused(std::string(name) + " is " + std::to_string(p.width) + "x" + std::to_string(p.height) +
                   " and colour " + std::to_string(width) + "x" + std::to_string(height) +
                   "; they must be of one size");
}

Status TakenShot::take(const petzval_shot* given, TakenShot& into) {
    if (!given) return refused("shot is null");
    const petzval_shot shot = taken(given);
    const auto colour = colour_view(shot.colour, "colour");
    if (!colour) return colour.error();
    into.colour = Picture::uninitialised(colour->width, colour->height);
    read_pixels(*colour, into.colour);
    into.job.colour = into.colour;
    if (Status ok = take_depth(shot, into); !ok) return ok;
    if (shot.mask) {
        if (Status ok = take_plane(shot.mask, into, "mask", into.mask); !ok) return ok;
        into.job.mask = into.mask;
    }
    const Rect display = rect_of(shot.display_window), data = rect_of(shot.data_window);
    into.job.place.data_window = data.empty() ? into.colour.rect() : data;
    into.job.place.display_window = display.empty() ? into.job.place.data_window : display;
    if (!into.job.place.fits(into.colour.width(), into.colour.height()))
        return refused("data_window is not of the picture's size");
    if (shot.pixel_aspect != 0) into.job.place.pixel_aspect = shot.pixel_aspect;
    if (shot.camera) into.job.camera = camera_of(taken(shot.camera));
    struct Deep {
        const petzval_deep* given;
        const char* name;
        DeepPicture& own;
        const DeepPicture*& of_job;
    };
    for (const Deep& d : {Deep{shot.deep, "deep", into.deep, into.job.deep},
                          Deep{shot.behind, "behind", into.behind, into.job.behind},
                          Deep{shot.holdout, "holdout", into.holdout, into.job.holdout}}) {
        if (Status ok = take_deep(d.given, into, d.name, d.own); !ok) return ok;
        if (d.given) d.of_job = &d.own;
    }
    return take_lights(shot, into);
}

}  // namespace petzval::c
