#include "prepare.h"

#include "petzval/frames.h"
#include "petzval/lens.h"
#include "petzval/lens_facts.h"
#include "petzval/scene.h"

#include <algorithm>
#include <numeric>

namespace petzval::view {
namespace {

// Lists the frames: those files that exist, where the path holds a place for a number; of a built-in scene
// its own, and 48 at least: the camera may move where the scene stands still.
Status find_frames(Setup& setup) {
    if (!setup.scene.empty()) {
        constexpr int kFewest = 48;
        for (const SceneSummary& known : scene_list())
            if (known.name == setup.scene) setup.scene_frames = known.frames;
        setup.frames.resize(std::size_t(std::max(kFewest, setup.scene_frames)));
        std::iota(setup.frames.begin(), setup.frames.end(), 0);
        return Done{};
    }
    const auto pattern = FramePattern::find(setup.run.source.path);
    if (!pattern) return pattern.error();
    if (!*pattern) return Done{};
    const auto there = (*pattern)->frames_there();
    if (!there) return there.error();
    if (there->empty()) return Error{ErrorCode::InvalidFile, setup.run.source.path + ": no frame exists"};
    setup.frames = *there;
    return Done{};
}

// The widest aperture of the lens as a number, where it is asked for: the window changes numbers.
Status open_wide(CameraChoice& camera, const LensChoice& chosen) {
    if (!camera.wide_open) return Done{};
    const auto lens = Lens::open(chosen);
    if (!lens) return lens.error();
    const auto widest = widest_f_number(*lens);
    if (!widest) return widest.error();
    camera.f_number = *widest;
    camera.wide_open = false;
    return Done{};
}

}  // namespace

Status prepare(Setup& setup) {
    ShotRunSettings& run = setup.run;
    if (Status open = open_wide(run.source.camera, run.look.lens); !open) return open;
    Choice& choice = setup.choice;
    choice.scene_camera = setup.scene_camera;
    choice.camera = run.source.camera;
    choice.look = run.look;
    choice.develop = run.display.settings(false, run.transfer, setup.session_settings.threads);
    choice.develop.dither = false;  // the same codes wherever a part of it begins
    choice.ocio = !run.display_view.empty();
    for (const auto& files : {files_of(run.source), files_of(run.look)})
        for (const std::string& file : files) setup.files.reads(file);
    for (const std::string& file : {run.source.lights, setup.against, setup.script}) setup.files.reads(file);
    SessionSettings settings = setup.session_settings;
    setup.session = std::make_shared<Session>(settings);
    if (settings.device != "cpu") {
        settings.device = "cpu";
        setup.cpu_session = std::make_shared<Session>(settings);
    }
    return find_frames(setup);
}

}  // namespace petzval::view
