// The waist every defocus engine fits through: one input, one output, one line in a list.
//
// The api room has checked everything by the time an engine runs: sizes agree, colour is finite, circles of
// confusion are finite, the picture is not empty. An engine validates nothing and throws nothing but
// std::bad_alloc.
#pragma once

#include "petzval/engine_options.h"
#include "petzval/engine_report.h"
#include "petzval/image.h"
#include "petzval/light_point.h"
#include "petzval/result.h"

#include "base/parallel.h"
#include "base/progress.h"
#include "image/big_vector.h"
#include "kernel/model/lens_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace petzval::device {
class Canvas;
class Device;
class Memory;
}  // namespace petzval::device

namespace petzval::engine {

// One thing seen in one pixel: premultiplied colour with its own coverage colour.a, signed CoC radius of its
// front and of its back (equal for a surface).
struct CocSample {
    Rgba colour;
    float coc_px = 0, coc_back_px = 0;
    float empty = 0;  // share of the pixel that is emptiness from here on: nothing behind is ever seen there
};

// Emptiness that takes what everything else leaves of a pixel's lens; the last of its samples.
inline CocSample emptiness_behind_everything() { return {{}, 0, std::numeric_limits<float>::infinity(), 1}; }
inline bool is_behind_everything(const CocSample& s) { return s.empty > 0 && std::isinf(s.coc_back_px); }

// Samples per pixel, nearest (smallest CoC) first, rows top to bottom; a view, owned by CocSamples.
class CocSamplesView {
public:
    CocSamplesView() = default;
    CocSamplesView(std::span<const std::size_t> first, std::span<const CocSample> samples, int width)
        : first_(first), samples_(samples), width_(width) {}
    bool empty() const { return first_.empty(); }
    int width() const { return width_; }
    int height() const { return width_ > 0 ? int((first_.size() - 1) / std::size_t(width_)) : 0; }
    std::span<const CocSample> at(int x, int y) const {
        const std::size_t i = std::size_t(y) * std::size_t(width_) + std::size_t(x);
        return samples_.subspan(first_[i], first_[i + 1] - first_[i]);
    }
    std::span<const std::size_t> first() const { return first_; }
    std::span<const CocSample> samples() const { return samples_; }
    // Rows y0…y1-1 alone.
    CocSamplesView rows(int y0, int y1) const {
        if (empty()) return {};
        const std::size_t from = std::size_t(y0) * std::size_t(width_),
                          to = std::size_t(y1) * std::size_t(width_);
        return {first_.subspan(from, to - from + 1), samples_, width_};
    }

private:
    std::span<const std::size_t> first_;  // width * height + 1 entries, or empty: none
    std::span<const CocSample> samples_;
    int width_ = 0;
};

struct CocSamples {
    int width = 0;
    BigVector<std::size_t> first;
    BigVector<CocSample> samples;
    operator CocSamplesView() const { return {first, samples, width}; }
    int height() const { return CocSamplesView(*this).height(); }
};

// Which edges of the picture are merely where the render stopped (the scene goes on beyond them), as against
// edges of a data window inside the frame, beyond which there is nothing.
struct OpenEdges {
    bool left = true, top = true, right = true, bottom = true;
};

// A lens, and where the pixels of a picture lie in its field.
struct LensOnPicture : PixelField {
    // The lens on pixels 1, 2, 4, … times as wide: lens_levels[n]. At least one; the last stands for all
    // beyond.
    std::span<const std::unique_ptr<const kernel::LensModel>> lens_levels;
    Rect frame;  // the display window, in pixels of the picture: zones of the lens are parts of it

    const kernel::LensModel& lens(int level) const {
        return *lens_levels[std::min(std::size_t(level), lens_levels.size() - 1)];
    }
    // Of a picture that begins at pixel (x, y) of this one.
    LensOnPicture from(int x, int y) const {
        LensOnPicture lens = *this;
        lens.field_centre_x -= x, lens.field_centre_y -= y;
        lens.frame = frame.moved(-x, -y);
        return lens;
    }
};

// A lens as the light of a lamp sees it: lens_levels.
struct LampLens {
    LightSpectrum light = LightSpectrum::Daylight;
    std::vector<std::unique_ptr<const kernel::LensModel>> levels;
};

class PlanReader;  // engine/scatter/plan.h

struct Input : LensOnPicture {
    // Another picture of the same things, drawn alike. Light: a share of `colour`'s; else of its coverage.
    struct Layer {
        View<const Rgba> colour;
        bool is_light = true;
    };
    View<const Rgba> colour;   // premultiplied; the front view of `deep` where that is given
    View<const float> coc_px;  // signed radius, + behind focus
    // Of this size, where nobody asks for `colour` once the samples are made: the result may be put in its
    // memory. Null: none.
    Picture* spent = nullptr;
    // The memory of coc_px, where nobody asks for it once an engine has seen all that it wants. Null: kept.
    Plane* spent_coc_px = nullptr;
    // Where `colour` is a layer of a picture: that picture. Empty otherwise.
    View<const Rgba> picture;
    // Both with the light that was taken out of them to be drawn by itself: what goes on behind an edge is as
    // bright as what shows. Empty: none was.
    View<const Rgba> lit, lit_picture;
    // Every sample of every pixel, when the input knows more than its front view (deep files, hidden layers);
    // then colour and coc_px are not all there is to hit. Empty otherwise.
    CocSamplesView deep;
    // What is known of a picture without the things in front; then `deep` holds them both. Empty: no plate.
    struct Plate {
        View<const Rgba> colour;
        View<const float> coc_px;
        bool all = false;  // also what no ray can reach: for those who look at samples
        bool empty() const { return coc_px.empty(); }
    };
    Plate plate;
    // What a coverage below 1 in `deep` means. True: as in deep files, each sample dims what is behind it in
    // its pixel, as thin fog does. False: it is the share of the pixel's area that a surface fills, and
    // others lie beside it.
    bool deep_dims_itself = false;
    // Light that lands in a pixel is dimmed by these samples of that pixel that lie in front of where it came
    // from (engine/waist/holdout.h). Coverages as in deep files: each sample dims what is behind it. Empty:
    // none.
    CocSamplesView holdout;
    std::vector<Layer> layers;  // for engines that take them; of the picture's size
    OpenEdges open_edges;
    // What this is a part of, for what an engine must know of all the frame; null: it is all of it.
    const Input* whole = nullptr;
    float nearest_coc_px = 0, farthest_coc_px = 0;  // smallest and largest radius anywhere in the frame
    const device::Device* device = nullptr;         // what draws; never null
    // What may outlive this frame, of this lens, size and quality alone; never null.
    device::Memory* memory = nullptr;
    // What looks at scatter's plan in place of a result; null: nobody.
    PlanReader* plan_reader = nullptr;
    Quality quality = Quality::Standard;
    int pupil_points = 4096;
    Fill fill = Fill::Full;
    GatherOptions gather;
    GaussianOptions gaussian;
    SpriteOptions sprites;
    std::span<const LightPoint> points;  // checked; coc_px holds the radius of each
    std::span<const LampLens> lamps;     // for points whose spectrum is none of the picture's
    double tan_per_field = 0;            // of the angle from the axis, per half diagonal; 0: not known
    View<const float> depth_m;           // planar, may hold misses; empty where radii were given
    double focus_distance_m = 0;         // 0: unknown
    float radius_at_infinity_px = 0;     // 0: unknown
    Workers* workers = &one_thread();    // never null
    std::size_t max_memory_bytes = 0;
    std::size_t beside_bytes = 0;  // of the same limit, what others hold while the engine runs
    std::uint64_t seed = 1;
    Progress* progress = nullptr;

    int width() const { return colour.width(); }
    int height() const { return colour.height(); }
    // What decisions look at, so that those of all layers agree.
    View<const Rgba> judged() const { return picture.empty() ? colour : picture; }
    const Input& all() const { return whole ? *whole : *this; }
    Input with_all_light() const {
        Input with = *this;
        if (!lit.empty()) with.colour = lit, with.picture = lit_picture;
        return with;
    }
    // Rows y0…y1-1 as an input of their own, while this one lasts. The edges towards the other rows count as
    // open.
    Input rows(int y0, int y1) const {
        Input part = *this;
        part.whole = &all();
        const Rect r{0, y0, width(), y1};
        part.colour = colour.part(r), part.coc_px = coc_px.part(r);
        if (!picture.empty()) part.picture = picture.part(r);
        if (!lit.empty()) part.lit = lit.part(r);
        if (!lit_picture.empty()) part.lit_picture = lit_picture.part(r);
        if (!depth_m.empty()) part.depth_m = depth_m.part(r);
        if (!plate.empty()) part.plate = {plate.colour.part(r), plate.coc_px.part(r), plate.all};
        for (Layer& layer : part.layers) layer.colour = layer.colour.part(r);
        part.deep = deep.rows(y0, y1), part.holdout = holdout.rows(y0, y1);
        static_cast<LensOnPicture&>(part) = from(0, y0);
        if (y0 > 0) part.open_edges.top = true;
        if (y1 < height()) part.open_edges.bottom = true;
        return part;
    }
};

// Every sample the input states: those of deep, or the one of each pixel.
CocSamples stated_samples(const Input& input);

struct Output {
    Picture image;
    std::shared_ptr<device::Canvas> canvas;  // or this in its place: not null where a device drew it
    std::vector<Picture> layers;             // those of the input, in its order
    std::vector<StageTime> stages;
    std::vector<std::string> warnings;
};

// What an engine makes of Input::layers.
enum class Layers {
    None,
    ByPlan,    // drawn by the picture's own plan
    OneByOne,  // decides by depth, alpha and Input::judged(): each layer is run as the picture
};

struct Engine {
    const char* name;
    const char* purpose;  // one line for help texts
    Result<Output> (*run)(const Input&);
    bool takes_holdout = false;
    Layers layers = Layers::None;
};

}  // namespace petzval::engine
