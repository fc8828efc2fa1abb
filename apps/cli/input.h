// A picture as a command gets it: read, depth turned into metres, camera put together, hidden layers beside
// it.
#pragma once

#include "petzval/deep.h"
#include "petzval/depth.h"
#include "petzval/files.h"
#include "petzval/result.h"

#include "camera.h"
#include "flags.h"
#include "values.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

// Flags that say what a file holds; empty means "find out and say so".
struct InputFlags {
    std::string path;
    ReadOptions read;
    std::optional<DepthKind> depth_kind;
    std::optional<Interval> depth_range;
    std::optional<double> unit_scale_m;
    std::string behind, holdout;
    std::vector<std::string> merge;
    std::optional<Transfer> transfer;

    void add_to(Verb& verb);           // IN, the layer and the view
    void add_depth_to(Verb& verb);     // all that says what depth is
    void add_transfer_to(Verb& verb);  // --transfer
    void add_others_to(Verb& verb);    // --behind, --merge, --holdout
    // Throws UsageError for depth flags that contradict each other.
    void check() const;
    bool depth_is_coc() const { return depth_kind == DepthKind::CocPx; }
};

struct Input {
    Frame frame;          // depth, also that of deep samples, is planar metres, or radii if depth_is_coc
    DeepPicture behind;   // empty without --behind; this and the next cover the window of `frame`
    DeepPicture holdout;  // empty without --holdout
    FoundCamera camera;   // flags over file
    DepthReport depth;    // zeros if there is none, or radii
    std::vector<std::string> detected, warnings;

    // Detected lines without those on camera numbers, which have their own line.
    std::vector<std::string> detected_in_picture() const;
};

// Errors: those of read_frame and depth_to_planar_metres; InvalidFile if --behind, --merge or
// --holdout does not fit.
Result<Input> load_input(const InputFlags& flags, const CameraFlags& camera);

// Grows the picture and all that goes with it by so many pixels of emptiness on each side where its data
// window ends inside the display window; elsewhere the scene goes on beyond the frame, unknown. Returns
// whether there is such a side. Errors: InvalidArgument for more pixels than any picture may have.
Result<bool> grow_empty_sides(Input& input, int by_px);

// Sets the focus distance to what the pixel shows. Errors: InvalidArgument if the picture has no such pixel.
Status focus_on_pixel(Input& input, Pixel pixel);
// The same by a point of the world, in scene units of `unit_scale_m` metres. Returns a warning, or nothing:
// where it lies behind OpenEXR's camera, the matrix is taken as one of a camera that looks along -z. Errors:
// InvalidArgument without a camera matrix, or for a point in the plane of the lens.
Result<std::string> focus_on_point(Input& input, WorldPoint place, double unit_scale_m);

}  // namespace petzval::cli
