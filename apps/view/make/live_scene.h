// A built-in scene instead of a file: rendered anew at every move of its camera.
#pragma once

#include "petzval/result.h"
#include "petzval/scene.h"
#include "petzval/session.h"
#include "petzval/shot.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace petzval::view {

struct Choice;

// Rotation of the view about the point in focus on the axis.
struct Orbit {
    double yaw_deg = 0, pitch_deg = 0, distance = 1;  // a factor

    bool is_home() const { return yaw_deg == 0 && pitch_deg == 0 && distance == 1; }
    bool operator==(const Orbit&) const = default;
};

// Orbits over the frames of a scene, as a hand made them.
struct CameraPath {
    std::map<int, Orbit> keys;
    bool recording = false;  // every move becomes a key of the frame that is shown

    // Evenly between keys; before the first and behind the last as there. Nothing without keys.
    std::optional<Orbit> at(int frame) const;
    // CSV: frame, yaw_deg, pitch_deg, distance. read() errors: InvalidFile with the path and the line.
    std::string text() const;
    static Result<CameraPath> read(const std::string& path);
};

// Position of a picture's camera, and the point on its axis at that distance.
struct Stand {
    ScenePoint at, target;
};
Stand stand_of(const FoundCamera& camera, double target_m);
// The pitch stays short of the zenith and, if the scene has a floor, above it.
Orbit within_reach(const Stand& own, Orbit orbit, std::optional<double> floor_m);
// Upright, short of the zenith.
Stand orbited(const Stand& own, const Orbit& orbit);

struct SceneWish {
    std::string name;
    SceneSettings settings;
    bool anew = false;  // its file is to be read again
    bool is_moving = false;
    int coarse = 1;  // so many by so many pixels are seen by the rays of one
};

// A scene that stays built while only its camera moves. For one thread at a time.
class LiveScene {
public:
    struct Seen {
        Shot shot;                         // of no file
        std::optional<double> subject_m;   // along the axis: where what the scene is about stands
        int frames = 1;                    // > 1: it moves
        std::vector<std::string> cameras;  // of a file: those to choose from
        double build_s = 0, render_s = 0;
    };
    // Errors: those of render_scene().
    Result<Seen> look(const SceneWish& wish, const std::function<bool()>& cancelled);

private:
    std::optional<StandingScene> standing_;
    std::string name_, camera_;
    int frame_ = 0;
};

// One frame of a recording, and the file that it becomes.
struct Recorded {
    SceneWish wish;
    std::string path;
};
// Pictures with depth and camera numbers, as `scene make` writes them: what defocus takes. Errors: those of
// render_scene(), OutputFailed.
Status record(const std::vector<Recorded>& frames);
// Records the window's results: made by the session at the look's quality; .exr as light, .png developed.
Status record_results(const std::vector<Recorded>& frames, const Choice& choice, bool follows_subject,
                      Session& session);
// A shot that no file was read for, made by the session, as an image file; an .exr says in petzval:history
// how.
Status save_result(const Shot& shot, const FoundCamera& camera, const Choice& choice, Session& session,
                   const std::string& path);
// The `scene make` command for that picture.
std::vector<std::string> scene_words(const SceneWish& wish, const std::string& output);

}  // namespace petzval::view
