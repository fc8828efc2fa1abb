// A C host's structs as the library takes them: pictures, samples, lights, threads.
#pragma once

#include "petzval/deep.h"
#include "petzval/depth.h"
#include "petzval/light_point.h"
#include "petzval/petzval_c.h"
#include "petzval/pixel_view.h"
#include "petzval/rendered.h"
#include "petzval/result.h"
#include "petzval/session.h"
#include "petzval/workers.h"

#include "c/handles.h"

#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval::c {

// A struct of a host that may be older or newer than we are: missing members are zero, unknown ones are
// left. Throws Unsized for one whose size does not even hold the size.
template <typename Struct>
Struct taken(const Struct* given) {
    Struct own{};
    if (!given) return own;
    std::size_t size = 0;
    std::memcpy(&size, given, sizeof size);
    if (size < sizeof size) throw Unsized{};
    std::memcpy(&own, given, size < sizeof own ? size : sizeof own);
    return own;
}

inline Error refused(const std::string& why) { return {ErrorCode::InvalidArgument, why}; }

// Errors: InvalidArgument naming the field that is missing or out of range; `name` is that of the picture.
Result<ColourView> colour_view(const petzval_pixels* given, const char* name);
Status check_plane(const petzval_plane* given, int width, int height, const char* name);

Camera camera_of(const petzval_camera& c);

Plane read_plane(const petzval_plane* given);

// A layer as it was given, and the memory for its result; without channels where it is not wanted.
struct ComparedLayer {
    ColourView colour, out;
    bool is_light = true;
    std::optional<LightSpectrum> spectrum;
};

// A shot whose pictures were compared with each other. Nothing of them was read.
struct ComparedShot {
    petzval_shot given;
    ColourView colour;
    Place place;
    std::vector<ComparedLayer> layers;
    std::optional<DepthSettings> meaning;  // of depth_m, where that is not planar metres
    // Errors: InvalidArgument naming the field.
    static Result<ComparedShot> compare(const petzval_shot* given);
};

// The pictures of a shot, read into ours.
struct TakenShot {
    Picture colour;
    Plane depth, mask;
    DeepPicture deep, behind, holdout;
    std::vector<LightPoint> lights;
    std::vector<Picture> layers;
    std::vector<std::string> warnings;  // about depth
    Rendered rendered;                  // all of these
    // Errors: InvalidArgument for deep samples that are not counted right, and for depth without a meaning.
    static Status take(const ComparedShot& compared, TakenShot& into);
};

// Errors: InvalidArgument naming the function that is missing.
Result<std::shared_ptr<Workers>> workers_of(const petzval_workers* given);
// Null: the defaults. Errors: InvalidArgument for a number of threads; those of lent workers.
Result<SessionSettings> session_settings_of(const petzval_session_settings* given);

}  // namespace petzval::c
