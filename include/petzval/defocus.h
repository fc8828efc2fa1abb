// The main function: makes the picture that a lens would have taken from a sharp picture with depth.
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

// All fields of Rendered, Look and Control in one struct (petzval/frame_stages.h).
struct DefocusJob {
    View<const Rgba> colour;  // scene-linear, premultiplied
    // The picture that `colour` views, if the caller no longer needs it: its memory may be reused for the
    // result. After the call its contents are unspecified.
    Picture* spent_colour = nullptr;
    View<const float> depth_m;  // planar metres, same size; +infinity for a miss
    // The signed radius of every pixel; depth_m is then empty, the camera's focus is not used, and depths
    // of `deep`, `behind` and `holdout` are radii too.
    View<const float> coc_px;
    // Treatment of soft silhouettes in depth_m, or in radii; deep pictures ignore it. The
    // report's warnings state what was found.
    DepthEdges depth_edges = DepthEdges::Auto;
    const DeepPicture* deep =
        nullptr;  // all samples of a deep input, same size; if given, it replaces colour and depth_m
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
    std::optional<Lens> opened_lens;  // if given, it replaces `lens`, and no file is read

    std::string engine = "scatter";  // one of engine_names()
    Quality quality = Quality::Standard;
    int pupil_points = 4096;  // reference only
    Fill fill = Fill::Full;
    ScatterOptions scatter;
    GatherOptions gather;      // gather, and sprites over it
    GaussianOptions gaussian;  // gaussian, and sprites over it
    SpriteOptions sprites;     // sprites; gather uses its search for lights too
    // For sprites only: lights to draw on top, hidden by nearer surfaces. Lights that cannot be drawn (not
    // finite, negative, outside the frame) are skipped, counted and reported.
    const std::vector<LightPoint>* points = nullptr;
    int threads = 0;                   // 0: all this process may use; the result never depends on it
    Workers* workers = nullptr;        // those of a host, in place of `threads`; null: our own
    std::size_t max_memory_bytes = 0;  // 0: no limit
    std::size_t held_bytes = 0;  // memory of the caller, such as other frames, that counts against the limit
    std::uint64_t seed = 1;
    // Folder for slow kernels between runs, with at most this many bytes; the least recently used are
    // removed first. Empty: none. The result never depends on it.
    std::string kernel_cache_folder;
    std::size_t kernel_cache_bytes = std::size_t(1) << 30;
    std::function<bool(double)> progress;  // share done 0…1, one call at a time; false cancels
};

struct DefocusReport {
    Picture image;                // same size as the input, unless options ask for several side by side
    std::vector<Panel> panels;    // if so: their positions
    std::vector<Picture> layers;  // those of the job, with the alpha of `image`
    // For ScatterView::Hidden: the engine's surfaces of every pixel, nearest first, visible and estimated;
    // `image` is the sharp picture then. Depth in metres, or radii if the job gives radii.
    DeepPicture hidden;
    std::string engine, device, lens;
    std::string glare_device;  // device that drew the glare; empty if there is none
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

// The pictures and camera of a job. Errors: InvalidArgument if it gives both depth and radii.
PETZVAL_API Result<Rendered> rendered_of(const DefocusJob& job);

}  // namespace petzval
