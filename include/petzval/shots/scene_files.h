// Renders a scene into files, like petzval scene make: the sharp picture with depth and camera numbers, the
// truth, the hidden surfaces; also many frames of a moving scene. Component petzval::scene-files, which
// joins petzval::scenes and petzval::files.
#pragma once

#include "petzval/camera.h"
#include "petzval/export.h"
#include "petzval/files.h"
#include "petzval/frame_loop.h"
#include "petzval/made_with.h"
#include "petzval/result.h"
#include "petzval/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

struct SceneFiles {
    std::string scene = {};                            // as StandingScene::build() takes it
    SceneSettings settings = {};                       // its camera, want_truth and want_layers are ignored
    CameraChoice camera = {};                          // overrides the scene's own numbers
    std::optional<ImageScale> image_scale = {};        // empty: the scene's own
    std::string output = {}, truth = {}, layers = {};  // .exr; empty: not written
    std::string record_file = {};                      // JSON of each frame; empty: none
    // Keep: existing files are neither rendered nor written. Update is not supported.
    ExistingOutputs existing = ExistingOutputs::Replace;
    std::size_t max_memory_bytes = 0;  // 0: no limit
};

// The names that are not empty, in the order of the struct.
PETZVAL_API std::vector<std::string> outputs_of(const SceneFiles& files);
// Refuses unknown scenes, outputs that are not EXR or are one file, and motion of a scene that stands still.
// make_scene_files() calls this function itself. Errors: InvalidArgument.
PETZVAL_API Status check(const SceneFiles& files);
// Sets the size of a picture; a side that is not given keeps the shape that the settings had.
PETZVAL_API void set_size(SceneSettings& settings, std::optional<int> width, std::optional<int> height);

// The scenes and point sets with their cameras, as `petzval scene list` shows them: for people, and its JSON.
PETZVAL_API std::string scene_list_text();
PETZVAL_API std::string scene_list_record();

// A scene's camera in the form of a file's camera; `origin`: such as "scene night".
PETZVAL_API FoundCamera found_camera(const Camera& camera, const std::string& origin);

// One frame: paths hold no frame number. The record is that of `petzval scene make --json`; it is empty for
// a frame that is kept. Of `host`, only `say`, `cancelled` and `in_words` are called. Errors: those of
// render_scene(); OutOfMemory if the pictures do not fit max_memory_bytes; OutputFailed, Cancelled.
PETZVAL_API Result<FrameRecord> make_scene_files(const SceneFiles& files, const FrameLoopHost& host = {});

// Many frames: each path holds a frame number (frames.h). The work of a FrameLoop. Errors of frames: those
// above.
PETZVAL_API FrameWork work_of(const SceneFiles& files, const FrameLoopHost& host);

// The lights of a point set as a file for ShotSource::lights, whose first lines name the set and the camera.
struct PointsFile {
    std::string set;  // as make_points() takes it
    PointSettings settings = {};
    std::string output = {};  // .csv
    ExistingOutputs existing = ExistingOutputs::Replace;
};
// The record is that of `petzval scene points --json`; it is empty for a file that is kept. Of `host`, only
// `say` is called. Errors: those of make_points(); OutputFailed.
PETZVAL_API Result<FrameRecord> make_points_file(const PointsFile& file, const FrameLoopHost& host = {});

}  // namespace petzval
