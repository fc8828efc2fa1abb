// A run over the frames of a shot: frames and patterns, missing inputs, existing outputs, tracks,
// neighbouring frames, retries, records. The command line, the window and render farms use it. Component
// petzval::files.
//
//     auto settings = petzval::shot_run_from_json(R"({"input": "beauty.####.exr", "output": "out.####.exr",
//                                                     "frames": "1001-1100", "camera": {"f_number": 2}})");
//     petzval::Session session;
//     petzval::ShotRun run(session, std::move(*settings), {.frame_done = [](const auto& done) {
//         std::puts(done.record.c_str());
//         return true;                       // false stops the run
//     }});
//     petzval::Status done = run.run();
#pragma once

#include "petzval/develop.h"
#include "petzval/display_files.h"
#include "petzval/engine_options.h"
#include "petzval/export.h"
#include "petzval/frame_loop.h"
#include "petzval/look.h"
#include "petzval/made_with.h"
#include "petzval/motion.h"
#include "petzval/neighbours.h"
#include "petzval/result.h"
#include "petzval/session.h"
#include "petzval/shot.h"
#include "petzval/track.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace petzval {

// The picture that is written.
enum class ShotView {
    Beauty,
    Coc,
    Focus,
    Depth,
    Alpha,
    Sharp,
    BlurSmall,
    BlurLarge,
    BlurRows,
    FocusIndex,
    Levels,
    Layers,
    Highlights,
    Hidden,
    Guessed
};
// Each view with its name, in reading order.
PETZVAL_API const std::vector<std::pair<std::string, ShotView>>& shot_views();
PETZVAL_API const char* name_of(ShotView view);
// True if an engine makes the view; its PNG is developed (exposure, tone).
PETZVAL_API bool is_rendered(ShotView view);
PETZVAL_API bool is_developed(ShotView view);
// The engine's own view. For views of other engines, gaussian_view() returns nothing and scatter_view()
// returns Result.
PETZVAL_API std::optional<GaussianView> gaussian_view(ShotView view);
PETZVAL_API ScatterView scatter_view(ShotView view);

// The growth of the data window: a number of pixels, or one of these values.
constexpr int kOverscanAutomatic = 0, kOverscanWithinFrame = -1, kOverscanOff = -2;

// source.read.view_name of every view of a stereo file.
inline constexpr const char* kAllViews = "all";

// All settings of a run. Paths of the source and of the outputs may contain a frame number (frames.h);
// without one, and without frames, the run makes a single picture.
struct ShotRunSettings {
    ShotSource source;  // with the camera of the user; source.read.threads and max_memory_bytes hold for all
    std::optional<PixelPosition> focus_pixel = {};
    std::optional<WorldPoint> focus_point = {};
    double permissible_radius_px = 1;  // blur that still counts as sharp
    Look look = {};
    ShotView view = ShotView::Beauty;
    std::optional<int> overscan_px = {};
    // The part of the display window that is rendered and written, counted from its top left: the same pixels
    // as in the whole frame. A part beyond the window is cut, with a warning. For ShotView::Beauty of one
    // view.
    std::optional<Rect> region = {};
    DisplayChoice display = {};             // of PNG outputs
    std::optional<Transfer> transfer = {};  // of display codes, read and written; the user's choice
    // Names of the display view and space that ShotRunHost::to_display shows; ExistingOutputs::Update
    // compares them. Empty: `display` is used.
    std::string display_view = {}, display_space = {};

    std::string output;          // .exr or .png
    std::string record_file;     // JSON of each frame in a separate file; empty: none
    std::string report_file;     // one line of JSON a frame; empty: none
    std::string save_look_file;  // written after the first picture; empty: none
    ExistingOutputs existing = ExistingOutputs::Replace;

    std::vector<int> frames = {};  // empty: those that are there
    std::optional<MissingFiles> missing = {};
    std::string track_file = {};
    std::vector<std::string> rack = {};  // keys, as Track::rack() takes them
    std::optional<double> focus_speed = {};
    int temporal = 0;  // neighbouring frames on each side
    MotionReading motion = {};
    int retries = 0;  // of a frame that failed for a reason other than its input

    // For records: the folder where the session stores kernels, and the engine's own options as JSON.
    std::string kernel_cache_folder = {}, engine_options = "{}";
    // Added to the warnings of each frame, such as fields of a look without effect.
    std::vector<std::string> warnings = {};
};

// Refuses settings that contradict each other, and files and choices that the view, the engine or the
// format of the output does not use, with their field. An empty output is not known yet: what depends on it
// is not checked. Runs call this function themselves. Errors: InvalidArgument.
PETZVAL_API Status check(const ShotRunSettings& settings);
// The part of it about a look and the pictures of its shot, for hosts that choose the rest later.
PETZVAL_API Status check(const ShotSource& source, const Look& look);

// ShotRunSettings::motion by one word: "off", cameras only; "still", no motion; "estimate", from colour and
// depth; else the layer of the vectors, empty: found by name.
PETZVAL_API MotionReading motion_reading(const std::string& word);
// The word for which motion_reading() returns this choice.
PETZVAL_API std::string motion_word(const MotionReading& motion);

// Settings as JSON: {"input", "output", "frames": "1001-1100", "look": {…}, "camera": {"f_number", …},
// "focus_at": [x, y], "depth": FILE, "depth_kind", "depth_channel", "layer", "layers": […], "behind",
// "holdout", "mask", "merge": […], "lights", "track", "rack": […], "focus_speed", "temporal",
// "motion": as motion_reading() takes it, "motion_scale": [x, y] (y upwards), "existing":
// "replace" | "keep" | "update", "missing": "fail" | "skip" | "black", "retries", "report", "view",
// "overscan", "region": [x0, y0, x1, y1], "exposure", "contrast", "tone", "threads", "max_memory_bytes"}.
// Errors: InvalidArgument naming an unknown key or a wrong value.
PETZVAL_API Result<ShotRunSettings> shot_run_from_json(const std::string& text);

struct ShotRunHost : FrameLoopHost {
    std::function<bool(double)> frame_progress = {};  // within a frame; false cancels
    // Converts scene-linear light by a colour manager instead of the tone curve. `light` becomes display
    // values, `settings` the remaining steps, and `used` a line that names the conversion.
    std::function<Status(Picture& light, DevelopSettings& settings, std::string& used,
                         std::vector<std::string>& warnings)>
        to_display = {};
    // Returns an example with camera numbers, which the run appends to the error about missing ones.
    std::function<std::string(const FoundCamera&)> camera_example = {};
};

// Refuses a display view together with the tone, contrast and transfer that it replaces, and a working space
// without a view. check(ShotRunSettings) and check(DevelopShot) include it. Errors: InvalidArgument.
PETZVAL_API Status check_display(const DisplayChoice& display, std::optional<Transfer> transfer,
                                 const std::string& display_view, const std::string& display_space);

// Makes one picture: paths of the settings have no frame number, and track, rack and frames are ignored.
// Errors: those of reading, of settings that do not fit each other, OutputFailed, Cancelled.
PETZVAL_API Result<FrameRecord> make_picture(Session& session, const ShotRunSettings& settings,
                                             const ShotRunHost& host = {});

class PETZVAL_API ShotRun {
public:
    // The session must outlive the run; it keeps data from frame to frame.
    ShotRun(Session& session, ShotRunSettings settings, ShotRunHost host = {});
    ~ShotRun();
    ShotRun(const ShotRun&) = delete;
    ShotRun& operator=(const ShotRun&) = delete;

    // Checks everything that can be refused before the work: frames, missing files, outputs that would
    // replace an input, the track, the needs of neighbours. `files` has more files of this process; may be
    // null. run() calls plan() if it was not called. Errors: InvalidArgument, InvalidFile.
    Status plan(RunFiles* files = nullptr);
    // The frames of the run; call plan() first.
    const std::vector<int>& frames() const;
    // Makes one frame outside of the loop, without retry and callbacks.
    Result<FrameRecord> make(int frame);
    // Makes all frames; a failed frame does not stop the run. Errors: those of plan(), Cancelled,
    // OutputFailed for the report.
    Status run();
    // Frames that failed.
    const std::vector<int>& failed() const;
    std::optional<ErrorCode> failure() const;  // as FrameLoop says it

private:
    struct State;
    std::unique_ptr<State> state_;
};

// The cost of one frame of a run, used to divide a shot among processes.
struct FrameCost {
    int frame = 0;
    double seconds = 0;
    std::size_t peak_memory_bytes = 0;  // of the process
};
// Makes a frame in a temporary file in `folder`, removes the file, and writes nothing else. Errors: those
// of ShotRun::make().
PETZVAL_API Result<FrameCost> measure_frame(Session& session, ShotRunSettings settings, int frame,
                                            const std::string& folder, const ShotRunHost& host = {});

// The memory available to this process under a memory cgroup (containers, farms) or ulimit -v.
struct MemoryLimit {
    std::size_t bytes = 0;  // left for work; 0: no limit, or none below the machine's memory
    std::string name;       // for messages
    std::string setting;    // the setting that a user would change
    // The value of that setting for work of so many bytes.
    std::function<std::size_t(std::size_t)> for_bytes;

    // For a message about too little memory ("… at least 234M …"), text that names a sufficient value.
    // Empty if the message names no amount.
    PETZVAL_API std::string enough(const std::string& message) const;
};
// threads: number of working threads, each of which needs a stack; 0: all.
PETZVAL_API MemoryLimit memory_limit(int threads = 0);

}  // namespace petzval
