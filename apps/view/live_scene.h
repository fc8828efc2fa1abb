// A built-in scene instead of a file: rendered anew at every move of its camera.
#pragma once

#include "petzval/result.h"
#include "petzval/scene.h"
#include "petzval/shot.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace petzval::view {

// From where a scene is seen, besides its own view: turned about the point in focus on the axis.
struct Orbit {
    double yaw_deg = 0, pitch_deg = 0, distance = 1;  // a factor

    bool is_home() const { return yaw_deg == 0 && pitch_deg == 0 && distance == 1; }
    bool operator==(const Orbit&) const = default;
};

// Where the camera of a picture stood, and the point on its axis so many metres away.
struct Stand {
    ScenePoint at, target;
};
Stand stand_of(const FoundCamera& camera, double target_m);
// Upright, short of the zenith.
Stand orbited(const Stand& own, const Orbit& orbit);

struct SceneWish {
    std::string name;
    SceneSettings settings;
};

// The picture with its depth as a shot of no file. Errors: those of render_scene().
Result<Shot> shot_of(const SceneWish& wish, const std::function<bool()>& cancelled);
// Pictures with depth and camera numbers, as `scene make` writes them: what defocus takes. `paths`: one for
// each frame. Errors: also OutputFailed.
Status record(SceneWish wish, const std::vector<int>& frames, const std::vector<std::string>& paths);
// How `scene make` is asked for that picture.
std::vector<std::string> scene_words(const SceneWish& wish, const std::string& output);

}  // namespace petzval::view
