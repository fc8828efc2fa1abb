// Commands of a scene: its camera, its path, its frames as files.
#include "petzval/output.h"

#include "command_list.h"
#include "fields.h"

#include <algorithm>
#include <cmath>

namespace petzval::view {
namespace {

using Words = std::vector<std::string>;

Status no_scene() { return invalid("a picture has a fixed camera; start the window with --scene NAME"); }

}  // namespace

Status orbit(App& app, const Words& words) {
    const auto yaw = number_of(words[0]), pitch = number_of(words[1]);
    if (!app.is_live()) return no_scene();
    if (!yaw || !pitch) return invalid("orbit: not two angles");
    Orbit turned = app.state.orbit;
    turned.yaw_deg += *yaw, turned.pitch_deg += *pitch;
    app.turn_to(turned);
    return Done{};
}
Status dolly(App& app, const Words& words) {
    const auto factor = number_of(words[0]);
    if (!app.is_live()) return no_scene();
    if (!factor || !(*factor > 0.01 && *factor < 100)) return invalid("dolly " + words[0] + ": not a factor");
    Orbit nearer = app.state.orbit;
    nearer.distance = std::clamp(nearer.distance * *factor, 0.01, 100.0);
    app.turn_to(nearer);
    return Done{};
}
Status home(App& app, const Words&) {
    if (!app.is_live()) return no_scene();
    app.turn_to({});
    return Done{};
}
Status save_path(App& app, const Words& words) {
    if (!app.is_live()) return no_scene();
    if (app.state.path.keys.empty())
        return invalid("no camera path yet; set scene.recording on and turn the scene");
    if (Status fine = app.may_write(words[0]); !fine) return fine;
    if (Status done = write_text(words[0], app.state.path.text()); !done) return done;
    app.notice = "wrote " + words[0];
    return Done{};
}
Status load_path(App& app, const Words& words) {
    if (!app.is_live()) return no_scene();
    auto path = CameraPath::read(words[0]);
    if (!path) return path.error();
    app.state.path = std::move(*path);
    app.notice = "camera path: " + words[0];
    app.go_to(app.state.timeline.frame);
    return Done{};
}
Status forget_path(App& app, const Words&) {
    app.state.path = {};
    return Done{};
}
Status record(App& app, const Words& words) {
    if (!app.is_live()) return no_scene();
    app.error.clear();
    app.record(words[0]);
    return app.error.empty() ? Status(Done{}) : Status(invalid(app.error));
}

}  // namespace petzval::view
