// The window of `petzval view`: what it is given, and the door to it. Below this line it knows
// include/petzval/ alone; the table of look flags is handed to it.
#pragma once

#include "petzval/develop.h"
#include "petzval/look.h"
#include "petzval/result.h"
#include "petzval/run_files.h"
#include "petzval/session.h"
#include "petzval/shot.h"
#include "petzval/shot_run.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval::view {

// A field of a look as people choose it: a row of the program's table of look flags.
struct FieldRow {
    std::string heading, path;  // "Lens", "lens.blades"
    std::string flag, placeholder,
        help;  // "--blades", "N"; words with | between: one of them; empty: a switch
    // Conversions between typed text and JSON. Errors complete "--blades five: …".
    std::function<Result<std::string>(const std::string&)> to_json;
    std::function<std::string(const std::string&)> from_json;
};

// Files of the shot and the meaning of their depth. Empty names and values: the files say it.
struct InputChoice {
    std::string path = {}, layer = {}, view_name = {}, depth_file = {}, depth_channel = {};
    std::optional<DepthKind> depth_kind = {};
    std::optional<double> depth_near = {}, depth_far = {};  // range of the kinds that have one
    double unit_scale_m = 1;

    bool operator==(const InputChoice&) const = default;
};
InputChoice input_of(const ShotSource& source);
// The source with these files. Another path leaves out all files that stand beside the source's own.
ShotSource with_input(ShotSource source, const InputChoice& input);

// Choices made in the window; everything else keeps the command line's values.
struct Choice {
    InputChoice input;
    CameraChoice camera;
    Look look;
    std::optional<int> frame;  // of a shot; nothing: a single picture
    DevelopSettings develop;   // of display pictures
    bool ocio = false;
    std::string scene_camera;  // of a glTF scene's cameras: its name, or number from 1; empty: the first
};

struct Setup {
    // Settings of a frame that is saved, before the choices made in the window, and callbacks while it is
    // made, by another thread than the window's. host.to_display also shows OpenColorIO's displays in the
    // window.
    ShotRunSettings run;
    ShotRunHost host;
    std::vector<std::string> typed_files;  // words of a command line that name the files of run.source
    std::string scene;  // a built-in scene in place of files; run.source.path is only what it is called
    std::string scene_camera;
    int scene_width = 480, scene_height = 270;
    std::string against;  // a picture to compare with; empty: none
    int listen_port = 0;  // for pictures that are pushed (tev.h); 0: none
    std::string script;   // a file of commands; empty: a hand
    int width = 1280, height = 800;
    double scale = 0;  // of letters and lines; 0: the display's
    std::vector<FieldRow> fields;
    SessionSettings session_settings;

    // Filled by run().
    Choice choice;  // the first
    std::vector<int> frames;
    int scene_frames = 1;
    // cpu_session: to compare with, where the session's device is another; else null.
    std::shared_ptr<Session> session, cpu_session;
    // Pictures, lenses and the rest that the command line names: nothing that is saved may replace one.
    RunFiles files;
    // For the scene hexadrive: makes a second OpenGL context current on the calling thread, or releases it.
    std::function<void(bool current)> gl_context = {};
};

// Opens the window and returns when it is closed or its script has ended. Errors: Unsupported where no window
// can be had (no display, no OpenGL 3); those of the script: InvalidFile, InvalidArgument with its line.
Status run(const Setup& setup);

}  // namespace petzval::view
