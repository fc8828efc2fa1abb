// The flags of `defocus`: values, contradictions, and the job they make.
#pragma once

#include "petzval/camera.h"
#include "petzval/defocus.h"
#include "petzval/made_with.h"
#include "petzval/seen_elsewhere.h"
#include "petzval/session.h"

#include "camera.h"
#include "defocus_frames.h"
#include "defocus_views.h"
#include "flags.h"
#include "frames.h"
#include "input.h"
#include "look_flags.h"
#include "ocio.h"
#include "output.h"
#include "report.h"
#include "run_flags.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace petzval::cli {

// Overscan that is no number of pixels: as far as light reaches, the same within the frame, none.
constexpr int kAutomatic = 0, kWithinFrame = -1, kNoOverscan = -2;

inline const std::string kAllViews = "all";  // --view-name

struct DefocusFlags {
    InputFlags input;
    CameraFlags camera;
    FocusFlags focus;
    LookFlags look;
    std::string points;  // lights
    std::size_t max_memory_bytes = 0;
    std::optional<std::string> kernel_cache;  // a folder, or "off"
    std::string device = "cpu";               // SessionSettings::device
    std::string output;
    ViewKind view = ViewKind::Beauty;
    std::optional<int> overscan_px;  // or one of the above; not given: kWithinFrame
    DevelopFlags develop;
    OcioFlags ocio;
    OverwriteFlags overwrite;
    RunFlags run;
    FrameFlags frames;
    TrackFlags track;
    // One frame of a shot: values from the track, and the files of neighbouring frames.
    std::optional<TrackedFrame> tracked;
    std::vector<std::string> neighbours;
    // Set for a frame of a shot with --temporal: returns the background that neighbouring frames and other
    // eyes see.
    std::function<Result<SeenElsewhere>(const Shot&, std::span<const Shot* const> eyes)> around;

    void add_to(Verb& verb);
    // Adds the flags a window uses: input, look, display.
    void add_shown_to(Verb& verb);
    void check(const Verb& verb);  // throws UsageError for what is missing or contradicts
    void check_shown();            // the same for those of add_shown_to()
    std::vector<std::string> input_files() const;
    std::vector<std::string> pictures() const;  // those that are neither a look's nor a lens's
    // Settings that -u compares with those stored in the output.
    MadeWith made_with() const;
    static std::string default_kernel_cache();
    SessionSettings session() const;
    // The job with the choices of the flags.
    DefocusJob job(DefocusJob job) const;
    // Those that the report has no other place for.
    Json parameters_json(const DefocusJob& job) const;

private:
    void add_choices_to(Verb& verb);
    void add_session_to(Verb& verb);
    void check_choices();
    void add_engines_to(Verb& verb);
    void add_output_to(Verb& verb);
    Json engine_options_json() const;
    void check_coc_input() const;
    void check_view() const;
    void check_display() const;
};

// One frame, by the flags as they stand after check(). Errors: as the verb's.
Status defocus_frame(DefocusFlags& flags, Session& session);

}  // namespace petzval::cli
