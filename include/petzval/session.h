// A session keeps data between frames: workers, kernels, one memory budget. `petzval::defocus(job)` uses a
// session for one frame.
#pragma once

#include "petzval/camera.h"
#include "petzval/defocus.h"
#include "petzval/develop.h"
#include "petzval/engine_options.h"
#include "petzval/export.h"
#include "petzval/lens.h"
#include "petzval/look.h"
#include "petzval/rendered.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace petzval {

struct SessionSettings {
    int threads = 0;  // 0: all this process may use
    // Memory limit for frames in progress and for data kept between frames (at most an eighth of it; a
    // gibibyte without a limit). 0: no limit.
    std::size_t max_memory_bytes = 0;
    // Folder for slow kernels between runs, with at most this many bytes; the least recently used are
    // removed first. Empty: none.
    std::string kernel_cache_folder = {};
    std::size_t kernel_cache_bytes = std::size_t(1) << 30;
    std::shared_ptr<Workers> workers = nullptr;  // those of a host, in place of `threads`; null: our own
    // Device: "cpu", "gpu" (the first of devices() that is no CPU), "gpu:1", or "auto": the first that is
    // neither a CPU nor a software driver, otherwise the CPU. Engines without a device (reference) use the
    // CPU; the report names the device used.
    std::string device = "cpu";
};

// The folder of a user's kernels: $PETZVAL_KERNEL_CACHE, otherwise petzval/kernels in the user's cache folder
// ($XDG_CACHE_HOME, ~/.cache). Empty if the variable is "off" or there is no home folder.
PETZVAL_API std::string default_kernel_cache_folder();

// Applies the effects of a look's lens besides blur: falloff towards the corners, then glare. `picture` is
// already blurred. `rendered` gives its place in the frame and the camera; its pictures are not used.
// Errors: those of check(look), add_falloff() and add_glare().
PETZVAL_API Result<Picture> add_light(Picture picture, const DefocusJob& rendered, const Look& look);

// Request for a frame as display codes instead of light.
struct CodesWanted {
    DevelopSettings develop;  // its threads and workers are not used
    // Window of the codes, in pixels of the display window like the data window; black outside the picture.
    // Empty: the display window.
    Rect window = {};
};

// Control of one frame.
struct Control {
    std::function<bool(double)> progress = {};  // share done 0…1, one call at a time; false cancels
    // True cancels. Called often, by any thread at any time; may read a flag that another thread sets.
    std::function<bool()> cancelled = {};
    // Makes only this part of the frame, in pixels of the display window, as the data window is. The image
    // is that part, bit for bit as in the whole frame. The cost is that of the part grown by
    // region_margin_px(); with glare it is that of the whole frame. Views and stages that replace the
    // result cover the whole frame.
    std::optional<Rect> region = {};
    // For take() only: the report then holds the frame as codes, and its image is empty. A frame drawn by a
    // GPU is read back as codes if no later step needs its light on the CPU. Buffers that are shown instead
    // of a result stay images.
    std::optional<CodesWanted> codes = {};
    // The look's lens, already opened, so that no file is read. Ignored if it differs from the look's lens.
    std::optional<Lens> lens = {};
    ScatterView view = ScatterView::Result;  // engine scatter: the buffer that replaces the result
    // Memory of the caller, such as other frames, that counts against the session's limit.
    std::size_t held_bytes = 0;
};

struct SessionUsage {
    std::size_t kept_bytes = 0;  // kernels, traced rays and stars kept between frames
    int lenses = 0;              // kept with their cameras
};

// A session may be used by any number of threads at once; simultaneous frames share the kept data. Results
// depend neither on earlier frames nor on simultaneous ones.
class PETZVAL_API Session {
public:
    explicit Session(SessionSettings settings = {});
    ~Session();
    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;

    // Makes the frame of a job; the session's settings replace the job's own. Errors: those of
    // petzval::defocus(); InvalidArgument or Unsupported if settings.device does not exist or cannot be used;
    // Unsupported with the field session.device if the device was lost; OutOfMemory, also for the device's
    // memory.
    Result<DefocusReport> defocus(const DefocusJob& job, const Control& control = {});
    // Only the blur of a look: no falloff, no glare, and a plate's highlights stay expanded. Choices
    // without effect are not listed. spare: as in FrameStages::begin(). Errors: those above, and of
    // Lens::open().
    Result<DefocusReport> defocus(Rendered rendered, Look look, const Control& control = {},
                                  Picture spare = {});
    // Makes a whole frame in the order of physics: expands a plate's highlights, blurs, applies falloff,
    // adds glare, and returns to the plate's range. `rendered` has the pictures, their place and the
    // camera; the look has all choices. Choices without effect are listed in the report's warnings but not
    // refused, because one look is used for drafts and final frames; check() lists them beforehand. Stage
    // "light" of the report is everything after the blur. spare: as in FrameStages::begin(). Errors: also
    // those of add_falloff(), add_glare(), expand_highlights() and check(), before any work.
    Result<DefocusReport> take(Rendered rendered, const Look& look, const Control& control = {},
                               Picture spare = {});
    // Uses the pictures, lens, view and memory of a job. Its other choices that differ from the look are
    // listed in the warnings.
    Result<DefocusReport> take(const DefocusJob& job, const Look& look, const Control& control = {});

    // The same as petzval::add_light() for the whole picture; control.region is ignored.
    Result<Picture> add_light(Picture picture, const Rendered& rendered, const Look& look,
                              const Control& control = {});
    Result<Picture> add_light(Picture picture, const DefocusJob& job, const Look& look,
                              const Control& control = {});

    // Margin around a region that affects it, in pixels: four times the largest radius, or the reach of the
    // lens's light at that radius if larger, and 175 for the search of hidden outlines. Errors: those of
    // defocus().
    Result<int> region_margin_px(const Rendered& rendered, const Look& look, const Control& control = {});
    Result<int> region_margin_px(const DefocusJob& job);

    // Largest distance, in pixels, between light of the largest radius and its source. Errors: those of
    // defocus().
    Result<double> reach_px(const Rendered& rendered, const Look& look, const Control& control = {});
    Result<double> reach_px(const DefocusJob& job);

    SessionUsage usage() const;
    // Releases the least recently used data until at most that many bytes are kept.
    void trim(std::size_t bytes);

private:
    friend class FrameStages;
    struct Contents;
    std::unique_ptr<Contents> contents_;
};

// The content of lens.bin for the programs of the shader kit (docs/explain/shader-kit.md).
struct RealtimeLensBuffer {
    std::vector<float> values;
    int taps = 0;               // of a disc
    int columns = 1, rows = 1;  // places of the frame that have kernels of their own
};
// The real-time pass's lens on a frame of this size. It takes 1.4, 1.6 or 2.3 MB for each place (draft,
// standard, final). Errors: those of the lens on that camera.
PETZVAL_API Result<RealtimeLensBuffer> realtime_lens_buffer(const Lens& lens, const Camera& camera,
                                                            int width_px, int height_px,
                                                            Quality quality = Quality::Standard);
// Its size, without making it. Errors: the same.
PETZVAL_API Result<std::size_t> realtime_lens_buffer_bytes(const Lens& lens, const Camera& camera,
                                                           int width_px, int height_px,
                                                           Quality quality = Quality::Standard);
// Checks that these bytes are a whole lens buffer for the programs of this version. Errors: InvalidFile.
PETZVAL_API Status check_lens_buffer(std::span<const std::byte> buffer);

}  // namespace petzval
