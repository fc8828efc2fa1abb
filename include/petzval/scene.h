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
    Camera camera;              // the numbers it is meant for
    int frames = 1;             // > 1: it moves
};

PETZVAL_API const std::vector<SceneSummary>& scene_list();

// A point of a scene's world: +x right, +y up, +z away from the scene's own camera, metres.
struct ScenePoint {
    double x = 0, y = 0, z = 0;
};

struct SceneSettings {
    int width = 960, height = 540;
    int overscan_px = 0;       // beyond the frame on every side, for all but the truth
    int samples = 64;          // per pixel for the pinhole picture's box filter
    int truth_samples = 1024;  // lens samples per pixel for the truth
    std::uint64_t seed = 1;
    int frame = 0;
    std::optional<Camera> camera;  // default: the scene's own
    std::string own_camera = {};   // of a file's the one of this name, or number from 1; empty: the first
    // Position of the camera, and the point in the middle of its picture; upright. Default: the scene's own
    // at that frame. With camera_at only, the direction stays.
    std::optional<ScenePoint> camera_at, look_at;
    // Depth as a network guesses it from a photograph: 1/depth blurred by a Gaussian of so many pixels'
    // standard deviation, and in 2^bits even steps. 0: exact. Truth and layers keep the exact depth.
    double depth_blur_px = 0;
    int depth_bits = 0;
    // Lit as programs did that took display codes for light: colours of things have the codes (gamma 2.2) of
    // theirs, lights such brightness as makes a white sheet its code, and codes are added. The pictures then
    // hold codes, to be shown as they are. Not of scenes that are shaded as they are seen, nor of files.
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
    Rect data_window;      // of all but the truth; the frame is {0, 0, width, height}
    Picture colour;        // pinhole, box-filtered
    Plane depth_m;         // planar, one unfiltered sample at the pixel centre; +infinity for a miss
    MotionVectors motion;  // when asked for: of what lies at the pixel's centre; NaN beyond the near plane
    Picture truth;         // through the lens, when asked for
    // Depth-peeled samples when asked for: every surface hidden behind the visible one, each with its own
    // coverage; in pixels where several surfaces show, also the visible ones with their own coverage. So the
    // visible picture comes first where the first sample lies behind depth_m, and is contained in the samples
    // elsewhere. A sample's depth is the mean of its surface in the pixel (of 1/depth); surfaces of one
    // object less than 1 % of their depth apart count as one; what is seen of the sky lies at +infinity.
    DeepPicture layers;
};

// Deterministic for the same settings and any thread count. Errors: InvalidArgument for an unknown scene (the
// message lists them) or numbers out of range; Cancelled.
PETZVAL_API Result<RenderedScene> render_scene(const std::string& name, const SceneSettings& settings);

// A scene that is built and lit once, and looked at from many places, by one thread at a time. `name`: a
// built-in one, or a glTF file, which ends in .gltf or .glb (by tinygltf, where it was found).
class PETZVAL_API StandingScene {
public:
    // Uses the frame, own_camera, lit_in_codes and the threads of the settings. Errors: those of
    // render_scene().
    static Result<StandingScene> build(const std::string& name, const SceneSettings& settings);
    ~StandingScene();
    StandingScene(StandingScene&&) noexcept;
    StandingScene& operator=(StandingScene&&) noexcept;

    // The same bits as render_scene(). Errors: also InvalidArgument for another frame than it was built for.
    Result<RenderedScene> render(const SceneSettings& settings);
    // Position of the scene's subject in this frame; nothing if the scene has no particular subject.
    std::optional<ScenePoint> subject() const;
    const Camera& camera() const;                      // the scene's own
    int frames() const;                                // > 1: it moves; of a file, 24 a second
    const std::vector<std::string>& cameras() const;   // of a file: those to choose from
    const std::vector<std::string>& warnings() const;  // of a file: what of it could not be read

private:
    struct Contents;
    explicit StandingScene(std::unique_ptr<Contents> contents);
    std::unique_ptr<Contents> contents_;
};

// Lights without a picture, for Rendered::lights: glitter on water, a city at night, drops on the lens.
struct PointSetSummary {
    std::string name, purpose;  // one line each
    int count = 0;              // lights, unless told otherwise
    bool has_horizon = false;
};

PETZVAL_API const std::vector<PointSetSummary>& point_set_list();

struct PointSettings {
    int width = 960, height = 540;  // of the picture they are meant for
    // The pinhole that sees them; it looks along the horizon, shifted so that this lies `horizon` of the
    // height below the top.
    double focal_length_mm = 50, sensor_width_mm = 36;
    double horizon = 0.5;
    int count = 0;  // 0: the set's own
    std::uint64_t seed = 1;
};

// Points ordered by depth, all finite, none negative; the same for the same settings on every machine with
// IEEE arithmetic. Light is scaled with the area a pixel sees, so that a larger picture shows the same
// lights. Errors: InvalidArgument for an unknown set (the message lists them), numbers out of range, or too
// many points.
PETZVAL_API Result<std::vector<LightPoint>> make_points(const std::string& name,
                                                        const PointSettings& settings);

}  // namespace petzval
