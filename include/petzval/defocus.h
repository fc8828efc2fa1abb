// The main door: a sharp picture with depth in, the picture a lens would have taken out.
#pragma once

#include "petzval/camera.h"
#include "petzval/deep.h"
#include "petzval/depth.h"
#include "petzval/engine_options.h"
#include "petzval/engine_report.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/lens.h"
#include "petzval/place.h"
#include "petzval/rendered.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// All fields of Rendered, Look and Control in one struct: a thin shim over them (petzval/frame_stages.h).
struct DefocusJob {
    View<const Rgba> colour;  // scene-linear, premultiplied
    // The picture that `colour` shows, where its owner needs it no more: the result may be put in its memory.
    // Whatever comes of the job, what it holds then is not said.
    Picture* spent_colour = nullptr;
    View<const float> depth_m;  // planar metres, same size; +infinity for a miss
    // The signed radius of every pixel instead of its depth, which stays empty: the camera is not asked, and
    // depths of `deep`, `behind` and `holdout` are radii too.
    View<const float> coc_px;
    // Treatment of soft silhouettes in depth_m, or in radii; deep pictures ignore it. The
    // report's warnings state what was found.
    DepthEdges depth_edges = DepthEdges::Auto;
    const DeepPicture* deep =
        nullptr;  // all samples of a deep input, same size; replaces colour and depth_m where given
    const DeepPicture* behind = nullptr;  // hidden layers, same size, see docs/conventions.md; may be null
    // A holdout matte of deep samples, same size, not blurred: light that lands in a pixel is dimmed by the
    // matte's samples there in front of the light's depth. For engines scatter and reference.
    const DeepPicture* holdout = nullptr;
    // Limits the effect, at the picture's size: 1 is the blurred picture, 0 is `colour`, values between mix
    // the two; everything that Session::take() does to light is limited. Empty: everywhere.
    View<const float> mask;
    std::vector<ColourLayer> layers;  // more layers of the same picture; for engine scatter
    // Position of the pixels in the display window, for the field position of lenses and the sensor's width.
    Place place;

    Camera camera;
    CocControls coc;
    LensChoice lens;
    std::optional<Lens> opened_lens;  // where given, it is taken instead of `lens`, and nothing is read

    std::string engine = "scatter";  // one of engine_names()
    Quality quality = Quality::Standard;
    int pupil_points = 4096;  // reference only
    Fill fill = Fill::Full;
    ScatterOptions scatter;
    GatherOptions gather;      // gather, and sprites over it
    GaussianOptions gaussian;  // gaussian, and sprites over it
    SpriteOptions sprites;     // sprites; what it finds, gather finds as well
    // For sprites only: lights to draw on top, hidden by nearer surfaces. Lights that cannot be drawn (not
    // finite, negative, outside the frame) are left out, counted and reported.
    const std::vector<LightPoint>* points = nullptr;
    int threads = 0;                   // 0: all this process may use; the result never depends on it
    Workers* workers = nullptr;        // those of a host, in place of `threads`; null: our own
    std::size_t max_memory_bytes = 0;  // 0: no limit
    std::size_t held_bytes = 0;        // what its caller holds beside, as frames around it; counts against it
    std::uint64_t seed = 1;
    // A folder in which kernels that take long to make are kept between runs, so many bytes at most, those
    // not used longest go first; empty: none. The result never depends on it.
    std::string kernel_cache_folder;
    std::size_t kernel_cache_bytes = std::size_t(1) << 30;
    std::function<bool(double)> progress;  // share done 0…1, one call at a time; false cancels
};

struct DefocusReport {
    Picture image;                // same size as the input, unless options ask for several side by side
    std::vector<Panel> panels;    // then: what lies where
    std::vector<Picture> layers;  // those of the job, with the alpha of `image`
    // For ScatterView::Hidden: the engine's surfaces of every pixel, nearest first, visible and estimated;
    // `image` is the sharp picture then. Depth in metres, or radii if the job gives radii.
    DeepPicture hidden;
    std::string engine, device, lens;
    std::string glare_device;  // who drew glare, as `device`; empty where there is none
    // Codes as requested by Control::codes, made like develop(); and the device that made them, as `device`.
    // Otherwise empty.
    std::vector<std::uint16_t> codes;
    std::string codes_device;
    double largest_radius_px = 0, smallest_radius_px = 0;  // signed: farthest behind, farthest in front
    std::vector<StageTime> stages;
    std::vector<std::string> warnings;
    std::size_t kernels_from_cache = 0;
};

PETZVAL_API std::vector<std::string> engine_names();

// Makes one frame in a new session (petzval/session.h). Errors: InvalidArgument (sizes differ, the
// picture is empty, a camera number is wrong, the engine or lens is unknown: the message names the field and
// the accepted values), OutOfMemory, Cancelled. The function throws nothing but std::bad_alloc. Non-finite
// colour counts as 0, non-finite depth as a miss.
PETZVAL_API Result<DefocusReport> defocus(const DefocusJob& job);

struct Look;

// The signed radius of every pixel, as the engines see it. Same errors as defocus().
PETZVAL_API Result<Plane> circle_of_confusion(const Rendered& rendered, const Look& look,
                                              Workers* workers = nullptr);
PETZVAL_API Result<Plane> circle_of_confusion(const DefocusJob& job);

// The pictures and camera of a job. Errors: InvalidArgument where it gives depth and radii.
PETZVAL_API Result<Rendered> rendered_of(const DefocusJob& job);

}  // namespace petzval
