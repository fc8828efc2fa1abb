// One picture file of a shot, its depth made what the whole shot knows depth by.
#pragma once

#include "petzval/files.h"
#include "petzval/shot.h"

#include <string>

namespace petzval::shot {

struct FileOfShot {
    Frame frame;  // its depth, also that of deep samples: planar metres, or radii where depth.kind says so
    DepthReport depth;
};

// Errors: those of read_frame() and depth_to_planar_metres(), with the path.
Result<FileOfShot> read_file(const std::string& path, const ReadOptions& read, const DepthSettings& depth);
// The same for depth that is there already. Ray depth needs the camera in `settings`.
Result<DepthReport> make_depth(Frame& frame, const DepthSettings& settings);

// All that a file shows: its deep samples, or one per pixel. Uses up the samples.
DeepPicture samples_of(Frame& frame);

// More pixels than read_frame() ever takes.
bool is_too_large(const Rect& r);

// A shot while it is read.
struct Reading {
    const ShotSource& source;
    Workers& workers;
    DepthSettings depth;  // with the camera's numbers
    Shot& shot;
    Plane& plane;  // of shot.depth
};

// Errors: InvalidFile where the other has another display window. `field` names the file.
Status same_frame(const Reading& reading, const Frame& other, const std::string& field);
// The smallest window that holds both.
Rect around(const Rect& a, const Rect& b);

// Extends the mask to the area that `window` adds, by its nearest pixel. Nothing for a shot without a mask.
void extend_mask(Shot& shot, const Rect& window);

// Reads data beside the picture from other files. Errors: those of read_shot().
Status merge_files(Reading& reading);
Status read_holdout(Reading& reading);
Status read_behind(Reading& reading);
Status read_mask(Reading& reading);

}  // namespace petzval::shot
