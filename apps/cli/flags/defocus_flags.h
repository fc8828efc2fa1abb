// The flags of `defocus`: values, contradictions, and the job they make.
#pragma once

#include "petzval/camera.h"
#include "petzval/session.h"
#include "petzval/shot_run.h"

#include "defocus_frames.h"
#include "flags/camera.h"
#include "flags/flags.h"
#include "flags/look_flags.h"
#include "flags/ocio.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "output.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace petzval::cli {

struct DefocusFlags {
    InputFlags input;
    CameraFlags camera;
    FocusFlags focus;
    LookFlags look;
    std::string points;  // lights
    std::size_t max_memory_bytes = 0;
    std::size_t memory_bytes() const {
        return max_memory_bytes > 0 ? max_memory_bytes : process_memory_bytes(run.threads);
    }
    std::optional<std::string> kernel_cache;  // a folder, or "off"
    std::string device = "cpu";               // SessionSettings::device
    std::string output;
    ShotView view = ShotView::Beauty;
    std::optional<int> overscan_px;  // or one of kOverscan…; not given: kOverscanWithinFrame
    std::optional<Rect> region;      // --roi
    DevelopFlags develop;
    OcioFlags ocio;
    OverwriteFlags overwrite;
    RunFlags run;
    FrameFlags frames;
    TrackFlags track;
    bool is_shot = false;  // many frames; known after check()

    void add_to(Verb& verb);
    // Adds the flags a window uses: input, look, display.
    void add_shown_to(Verb& verb);
    void check(const Verb& verb);             // throws UsageError for what is missing or contradicts
    void check_shown();                       // the same for those of add_shown_to()
    std::string kernel_cache_folder() const;  // empty: none
    SessionSettings session() const;
    // The flags as settings of a run, of many frames or of one picture.
    ShotRunSettings settings() const;

private:
    void add_choices_to(Verb& verb);
    void add_session_to(Verb& verb);
    void check_choices();
    void add_engines_to(Verb& verb);
    void add_output_to(Verb& verb);
    void check_coc_input() const;
    void check_view() const;
};

// Messages, progress and cancelling of a run of one picture on this program's terminal.
ShotRunHost picture_host(const DefocusFlags& flags);

}  // namespace petzval::cli
