// The built-in scenes: small procedural pictures with depth, and the truth a lens would have recorded.
// Optional component petzval::scenes (Embree).
#pragma once

#include "petzval/camera.h"
#include "petzval/deep.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/light_point.h"
#include "petzval/motion.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

struct SceneSummary {
    std::string name, purpose;  // one line each
    Camera camera;              // the scene's own camera
    int frames = 1;             // > 1: it moves
    // Height of the floor, m: a camera below it would see nothing else. Nothing: the scene has no floor.
    std::optional<double> floor_m = {};
};

PETZVAL_API const std::vector<SceneSummary>& scene_list();
// True if a scene of that name is a glTF file; other names are those of built-in scenes.
PETZVAL_API bool is_scene_file(const std::string& name);
// Errors: InvalidArgument for a name that is neither (the message lists the scenes), and for
// SceneSettings::own_camera where the scene is not a file.
PETZVAL_API Status check_scene(const std::string& name, const std::string& own_camera = "");

// A point of a scene's world: +x right, +y up, +z away from the scene's own camera, metres.
struct ScenePoint {
    double x = 0, y = 0, z = 0;
};

struct SceneSettings {
    int width = 960, height = 540;
    int overscan_px = 0;       // beyond the frame on every side, for all pictures except the truth
    int samples = 64;          // per pixel for the pinhole picture's box filter
    int truth_samples = 1024;  // lens samples per pixel for the truth
    std::uint64_t seed = 1;
    int frame = 0;
    std::optional<Camera> camera;  // default: the scene's own
    std::string own_camera = {};   // of a file's the one of this name, or number from 1; empty: the first
    // Position of the camera, and the point in the middle of its picture; upright. Default: the scene's own
    // at that frame. With camera_at only, the direction stays.
    std::optional<ScenePoint> camera_at, look_at;
    // Depth as renderers write it that filter it like colour: the mean of a pixel's samples, with the sky at
    // 1e10 m. Truth and layers stay exact, here and below.
    bool depth_is_mean = false;
    // Depth as a neural network estimates it from a photograph: 1/depth is blurred by a Gaussian of this
    // standard deviation in pixels and rounded to 2^bits even steps. 0: exact.
    double depth_blur_px = 0;
    int depth_bits = 0;
    // Lights the scene like programs that treated display codes as light: colours are replaced by their
    // codes (gamma 2.2), a light has the brightness that gives a white sheet its code, and codes are added.
    // The pictures then contain codes, to be shown unchanged. Not for scenes with their own shading, nor
    // for files.
    bool lit_in_codes = false;
    bool want_truth = false, want_layers = false;
    bool want_motion = false;              // of a scene that moves
    int threads = 0;                       // 0: all
    Workers* workers = nullptr;            // those of a host, in place of `threads`; null: our own
    std::function<bool(double)> progress;  // share done; false cancels
};

struct RenderedScene {
    Camera camera;
    // Matrix from the world to the camera, row by row, for row vectors (x, y, z, 1), as in OpenEXR's
    // worldToCamera. The camera looks along its +z; in the picture, +x is right and +y is up.
    std::array<double, 16> camera_from_world{};
    Rect data_window;      // of all pictures except the truth; the frame is {0, 0, width, height}
    Picture colour;        // pinhole, box-filtered
    Plane depth_m;         // planar, one unfiltered sample at the pixel centre; +infinity for a miss
    MotionVectors motion;  // if requested: of the surface at the pixel's centre; NaN beyond the near plane
    Picture truth;         // through the lens, if requested
    // Depth-peeled samples, if requested: every surface hidden behind the visible one, with its own
    // coverage; in pixels that show several surfaces, also the visible ones. So if a pixel's first sample
    // lies behind depth_m, the visible picture is in front of the samples; otherwise it is contained in
    // them. A sample's depth is the mean of its surface in the pixel (of 1/depth); surfaces of one object
    // less than 1 % of their depth apart count as one; the sky lies at +infinity.
    DeepPicture layers;
};

// Deterministic for the same settings and any thread count. Errors: InvalidArgument for an unknown scene (the
// message lists them) or numbers out of range; Cancelled.
PETZVAL_API Result<RenderedScene> render_scene(const std::string& name, const SceneSettings& settings);

// A scene that is built and lit once and rendered from many places, by one thread at a time. `name`: a
// built-in one, or a glTF file, which ends in .gltf or .glb (by tinygltf, where it was found).
class PETZVAL_API StandingScene {
public:
    // Uses the frame, own_camera, lit_in_codes and the threads of the settings. Errors: those of
    // render_scene().
    static Result<StandingScene> build(const std::string& name, const SceneSettings& settings);
    ~StandingScene();
    StandingScene(StandingScene&&) noexcept;
    StandingScene& operator=(StandingScene&&) noexcept;

    // The same bits as render_scene(). Errors: also InvalidArgument for a frame other than the one it was
    // built for.
    Result<RenderedScene> render(const SceneSettings& settings);
    // Position of the scene's subject in this frame; nothing if the scene has no particular subject.
    std::optional<ScenePoint> subject() const;
    const Camera& camera() const;                     // the scene's own
    int frames() const;                               // > 1: the scene moves; 24 frames per second for a file
    const std::vector<std::string>& cameras() const;  // of a file: the available ones
    const std::vector<std::string>& warnings() const;  // of a file: the parts that could not be read

private:
    struct Contents;
    explicit StandingScene(std::unique_ptr<Contents> contents);
    std::unique_ptr<Contents> contents_;
};

// Lights without a picture, for Rendered::lights: glitter on water, a city at night, drops on the lens.
struct PointSetSummary {
    std::string name, purpose;  // one line each
    int count = 0;              // default number of lights
    bool has_horizon = false;
};

PETZVAL_API const std::vector<PointSetSummary>& point_set_list();

struct PointSettings {
    int width = 960, height = 540;  // of the picture for which they are made
    // The pinhole camera. It looks along the horizon and is shifted so that the horizon lies at this
    // fraction of the height below the top.
    double focal_length_mm = 50, sensor_width_mm = 36;
    std::optional<double> horizon = {};  // not given: 0.5; only for sets that have one
    int count = 0;                       // 0: the set's own
    std::uint64_t seed = 1;
};

// Points ordered by depth, all finite, none negative; the same for the same settings on every machine with
// IEEE arithmetic. Light is scaled with the area of a pixel, so a larger picture shows the same lights.
// Errors: InvalidArgument for an unknown set (the message lists them), numbers out of range, a horizon of a
// set without one, or too many points.
PETZVAL_API Result<std::vector<LightPoint>> make_points(const std::string& name,
                                                        const PointSettings& settings);

}  // namespace petzval
