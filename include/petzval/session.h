// What outlives a frame: workers, kernels, one memory budget. `petzval::defocus(job)` is a session of one
// frame.
#pragma once

#include "petzval/defocus.h"
#include "petzval/develop.h"
#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace petzval {

struct SessionSettings {
    int threads = 0;  // 0: all this process may use
    // For everything: what a frame takes while it is made, and what is kept between frames (at most an eighth
    // of it; a gibibyte where there is no limit). 0: no limit.
    std::size_t max_memory_bytes = 0;
    // A folder in which kernels that take long to make are kept between runs, so many bytes at most, those
    // not used longest go first; empty: none.
    std::string kernel_cache_folder = {};
    std::size_t kernel_cache_bytes = std::size_t(1) << 30;
    std::shared_ptr<Workers> workers = nullptr;  // those of a host, in place of `threads`; null: our own
    // What draws: "cpu", "gpu" (the first of devices() that is no CPU), "gpu:1", or "auto": the first that is
    // neither a CPU nor a software driver, else the CPU. What engines make without a device (reference) the
    // CPU makes; the report says who drew.
    std::string device = "cpu";
};

// The job with all that a look chooses of a defocus.
PETZVAL_API DefocusJob with_look(DefocusJob job, const Look& look);

// What the lens of a look does to light besides blur, to a picture that is blurred already: light lost
// towards the corners, then glare. `rendered` says where the picture lies and what the camera was; its
// pictures are not asked for. Errors: those of check(look), add_falloff() and add_glare().
PETZVAL_API Result<Picture> add_light(Picture picture, const DefocusJob& rendered, const Look& look);

// A frame as codes of a display, in place of light.
struct CodesWanted {
    DevelopSettings develop;  // its threads and workers are not asked
    // What they show, in pixels of the display window as the data window is; black where nothing was made.
    // Empty: the display window.
    Rect window = {};
};

// How one frame is made.
struct Control {
    std::function<bool(double)> progress = {};  // share done 0…1, one call at a time; false cancels
    // True cancels; asked often, by any thread at any time: a flag that another thread sets.
    std::function<bool()> cancelled = {};
    // Makes this part of the frame alone, in pixels of the display window as the data window is; the image is
    // that part, bit for bit as in the whole. Costs the part with region_margin_px() around it, but for
    // glare, which takes the whole frame. Views and stages that are shown instead of a result are made whole.
    std::optional<Rect> region = {};
    // Of take() alone: the report's codes hold the frame then, and its image is empty. A frame that was drawn
    // by a GPU comes home as codes, if nothing is left to be done to its light there. Buffers that are shown
    // instead of a result stay images.
    std::optional<CodesWanted> codes = {};
};

struct SessionUsage {
    std::size_t kept_bytes = 0;  // kernels and stars kept between frames
    int lenses = 0;              // mounted on cameras, and kept
};

// Used by any number of threads at once; frames that are made at the same time share what is kept. Results
// depend neither on what was made before nor on what is made beside.
class PETZVAL_API Session {
public:
    explicit Session(SessionSettings settings = {});
    ~Session();
    Session(Session&&) noexcept;
    Session& operator=(Session&&) noexcept;

    // The settings of the session stand in place of the job's own. Errors: those of petzval::defocus();
    // InvalidArgument or Unsupported: settings.device is none that there is, or cannot be used; Unsupported:
    // it was lost, which the error's field, session.device, says too; OutOfMemory: also of its own.
    Result<DefocusReport> defocus(const DefocusJob& job, const Control& control = {});
    // A whole frame, in the order of physics: a plate's highlights given back, blur, light lost towards the
    // corners, glare, and back into the plate's range. `rendered` says what there is (pictures, place,
    // camera); all that is chosen is the look's. Choices without effect are listed in the report's warnings
    // and not refused, as one look serves drafts and final frames; check() tells them beforehand. Errors:
    // also those of add_falloff(), add_glare(), expand_highlights() and of check(), before any work. All that
    // follows the blur is the stage "light" of the report.
    Result<DefocusReport> take(const DefocusJob& rendered, const Look& look, const Control& control = {});

    // What petzval::add_light() does. control.region: none; the picture is whole.
    Result<Picture> add_light(Picture picture, const DefocusJob& rendered, const Look& look,
                              const Control& control = {});

    // How many pixels around a region are looked at for it: four of the largest radius, or of how far the
    // lens throws light at that radius if it is farther, and 160, in which it is told how outlines go on that
    // something hides. Errors: those of defocus().
    Result<int> region_margin_px(const DefocusJob& job);

    // How far, in pixels, light of the largest radius lands from where it came. Errors: those of defocus().
    Result<double> reach_px(const DefocusJob& job);

    SessionUsage usage() const;
    // Lets go of what was not used longest until at most so many bytes are kept.
    void trim(std::size_t bytes);

private:
    struct Contents;
    std::unique_ptr<Contents> contents_;
};

}  // namespace petzval
