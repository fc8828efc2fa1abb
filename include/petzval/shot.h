// A shot: rendered pictures, read from files and prepared for a session. Component petzval::files.
//
//     petzval::ShotSource source{.path = "beauty.exr"};
//     source.camera.f_number = 2;
//     auto shot = petzval::read_shot(source);               // pictures, depth in metres, camera, lights
//     auto rendered = petzval::rendered(*shot);             // what Session::take() is given; borrows the
//     shot
#pragma once

#include "petzval/camera.h"
#include "petzval/deep.h"
#include "petzval/defocus.h"
#include "petzval/depth.h"
#include "petzval/export.h"
#include "petzval/files.h"
#include "petzval/image.h"
#include "petzval/light_point.h"
#include "petzval/look.h"
#include "petzval/motion.h"
#include "petzval/place.h"
#include "petzval/result.h"
#include "petzval/session.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace petzval {

// Planar depth in metres; +infinity for a miss.
struct DepthMetres {
    Plane plane;
};
// Signed radii of the circle of confusion in pixels, + is far.
struct RadiiPx {
    Plane plane;
};
// Source of each pixel's blur; monostate if the file has none and none was requested.
using ShotDepth = std::variant<std::monostate, DepthMetres, RadiiPx>;

// The user's camera numbers, which override the file's.
struct CameraChoice {
    std::optional<double> focal_length_mm = {}, sensor_width_mm = {}, f_number = {}, focus_distance_m = {};
    ImageScale image_scale = ImageScale::Rendered;
    // Diameter of the entrance pupil, instead of an f-number: f_number is focal_length_mm / this. Ignored
    // if f_number is given.
    std::optional<double> aperture_diameter_mm = {};
    // Uses the widest aperture of the look's lens, if it has one, instead of an f-number; ShotRun and
    // make_picture() set it. Ignored if one of the two above is given.
    bool wide_open = false;
};

// Location of a shot's files. Messages name these fields as read.layer, depth.kind, shot.behind,
// camera.f_number.
struct ShotSource {
    std::string path;  // EXR or PNG
    // Choices for reading `path`; its threads or workers read all files of the shot.
    ReadOptions read = {};
    // Meaning of depth in all files of the shot: kind, unit, range. The camera's numbers and the threads are
    // filled in. CocPx: radii in pixels.
    DepthSettings depth = {};
    bool depth_kind_given = false;  // depth.kind is the user's choice, not the default
    // Clean plate: RGBA and Z or deep, of the same data window. Empty: none.
    std::string behind = {};
    std::string holdout = {};  // a matte that stays sharp and hides light behind it
    // Mask, "FILE" or "FILE:CHANNEL" of the same display window: any channel of an EXR; R, G, B or A of
    // other files, integers as fractions of full scale. Without a channel: alpha if it is not 1 everywhere,
    // otherwise luminance. Outside the file's pixels it is 0, beyond the frame its border value.
    std::string mask = {};
    std::vector<std::string> merge = {};  // more pictures of the shot, sorted in by depth
    std::string lights = {};              // CSV, see read_lights()
    CameraChoice camera = {};
};

struct Shot {
    std::string path;
    Place place;
    Picture colour;  // scene-linear Rec.709, premultiplied; the size of the data window, as all pictures here
    bool has_alpha = false;  // false: colour.a is 1 everywhere
    ShotDepth depth;
    DeepPicture deep;  // all samples of a deep input or of several files, else empty
    // Hidden layers, and a matte; empty where there are none. All three have depth in the unit of `depth`.
    DeepPicture behind, holdout;
    MotionVectors motion;  // as source.read.motion asks
    Plane mask;  // covers mask_window, the union of the frame and the data window; empty: everywhere
    Rect mask_window;
    // More layers of the colour's surfaces, as source.read.layers asks, blurred or copied.
    std::vector<FrameLayer> layers;
    std::vector<CarriedLayer> layers_carried;
    std::vector<LightPoint> lights;  // in pixels of the data window
    FoundCamera camera;              // the user's numbers over the file's, each with its origin
    FoundCamera camera_of_file;
    ImageScale image_scale = ImageScale::Rendered;
    double unit_scale_m = 1;  // metres per unit of the scene
    DepthReport depth_report;
    std::vector<std::string> views;  // as in Frame, and below
    std::string view, history, colour_name;
    // 8 or 16: read from display codes of so many bits, whose 1.0 is clipped highlights; 0: light.
    int code_bits = 0;
    bool display_referred() const { return code_bits > 0; }
    std::size_t non_finite_colour = 0;  // values that were replaced
    std::vector<PartSummary> parts;
    std::vector<std::string> detected, warnings;  // one line each, for logs and reports
    std::shared_ptr<const CarriedContent> carried;

    bool has_radii() const { return std::holds_alternative<RadiiPx>(depth); }
    // Metres or radii; empty where there are none.
    PETZVAL_API View<const float> depth_plane() const;
};

// Splits "FILE:CHANNEL"; if a file with the whole name exists, there is no channel.
struct FileChannel {
    std::string file, channel;
};
PETZVAL_API FileChannel file_channel(const std::string& text);

// The files that a source and a look name: pictures, depth, lights; the lens, if it is a file, and its
// pictures.
PETZVAL_API std::vector<std::string> files_of(const ShotSource& source);
PETZVAL_API std::vector<std::string> files_of(const Look& look);

// Errors: InvalidArgument for settings that contradict each other (depth.kind without its depth.range, …).
// That of a source includes that of its camera.
PETZVAL_API Status check(const CameraChoice& camera);
PETZVAL_API Status check(const ShotSource& source);

// Reads all files of the source. `control` is polled between files and in loops; its progress is called
// once per file. Errors: those of check(), read_frame() and depth_to_planar_metres(); InvalidFile if a file
// does not fit the picture (another window, or lights by depth with radii); Cancelled.
PETZVAL_API Result<Shot> read_shot(const ShotSource& source, const Control& control = {});

// The user's numbers over the file's; origins of the user's are field names, as camera.f_number. A distance
// that the file has in scene units is multiplied by `unit_scale_m`. With the field of view and one of focal
// length and sensor width known, the other follows.
PETZVAL_API FoundCamera merged_camera(const FoundCamera& file, const CameraChoice& user,
                                      double unit_scale_m = 1);
// Errors: InvalidArgument naming every number that is missing: "no f-number; give camera.f_number".
PETZVAL_API Result<Camera> complete_camera(const FoundCamera& found, ImageScale image_scale);

// Horizontal field of view in degrees with focus at infinity: from focal length and sensor if both are
// known, otherwise the file's.
PETZVAL_API std::optional<FoundNumber> field_of_view_deg(const FoundCamera& found);

// The same without errors: numbers that are missing are 0.
PETZVAL_API Camera known_camera(const FoundCamera& found, ImageScale image_scale);

// Lines of `detected` except those on camera numbers, which FoundCamera holds with their origins.
PETZVAL_API std::vector<std::string> detected_in_picture(const Shot& shot);

// The whole shot for a session, borrowed. A camera number may be missing if radii are given; it is 0 then.
// Errors: those of complete_camera().
PETZVAL_API Result<Rendered> rendered(const Shot& shot);

// A pixel of the display window, counted from its top left.
struct PixelPosition {
    int x = 0, y = 0;
};
// Sets the focus distance to the depth that the pixel shows. Errors: InvalidArgument for a pixel outside of
// the data window or a shot without depth in metres.
PETZVAL_API Status focus_on_pixel(Shot& shot, PixelPosition pixel);
// The median depth of non-empty pixels at most `within_px` columns and rows away; empty if there are none.
// Errors: those of focus_on_pixel().
PETZVAL_API Result<std::optional<double>> distance_around_m(const Shot& shot, PixelPosition pixel,
                                                            int within_px);

// A point of the world, in scene units.
struct WorldPoint {
    double x = 0, y = 0, z = 0;
};
// The same by a point of the world and the file's worldToCamera. If the point lies behind OpenEXR's camera,
// the camera is assumed to look along -z, with a warning in shot.warnings. Errors: InvalidArgument without
// a matrix, or for a point in the plane of the lens.
PETZVAL_API Status focus_on_point(Shot& shot, WorldPoint point);
// Refuses more than one choice of the focus: a distance, a pixel, a point of the world. Errors:
// InvalidArgument.
PETZVAL_API Status check_focus(const CameraChoice& camera, const std::optional<PixelPosition>& pixel,
                               const std::optional<WorldPoint>& point);

// Position of the camera in the world: the point that becomes the origin if the matrix holds only rotations.
PETZVAL_API std::optional<WorldPoint> position_of(const FoundCamera& found);

// If a range is kept sharp and no focus is given, sets the focus to the middle of the range in dioptres.
// Errors: InvalidArgument for a focus outside of the range.
PETZVAL_API Status focus_within_range(Shot& shot, const CocControls& coc);

// Reach of this look's light beyond the picture, in pixels: the largest radius of non-empty pixels, plus the
// displacement by distortion. Errors: those of rendered() and circle_of_confusion().
PETZVAL_API Result<int> reach_px(const Shot& shot, const Look& look);
// The data window grown by the distance that light of this look travels, where the window ends inside the
// display window: as far as the discs of visible pixels reach. spread: that distance in radii. within_frame:
// the result stays inside the display window. Errors: those of reach_px().
PETZVAL_API Result<Rect> window_of_light(const Shot& shot, const Look& look, double spread = 1,
                                         bool within_frame = false);
// Adds that many pixels on each side where the data window ends inside the display window; on other sides the
// scene continues beyond the frame, unknown.
PETZVAL_API Rect with_empty_sides(const Place& place, int by_px);
// Adds empty pixels around the picture. Requires: `wider` contains its data window. Returns true if it is
// larger. Errors: InvalidArgument for more pixels than any picture may have.
PETZVAL_API Result<bool> grow_to(Shot& shot, const Rect& wider);
// grow_to(with_empty_sides()).
PETZVAL_API Result<bool> grow_empty_sides(Shot& shot, int by_px);

// The line of the attribute petzval:history that describes this look's blur of the shot; it does not depend
// on time and place.
PETZVAL_API std::string history_line(const Shot& shot, const Look& look);
// True if the history of the file has such a line about this colour.
PETZVAL_API bool was_blurred(const Shot& shot);

// The frame for write_exr(): shot.colour in its place with all other data of the input, metres as its depth.
PETZVAL_API Frame to_frame(Shot shot);

// Lights in a CSV file. The first line that is not empty names the columns, in any order: x, y (pixels of
// the display window, centres at +0.5), depth (metres, planar) or coc (signed radius, px), r, g, b
// (scene-linear), and if wanted size (diameter, px); vx and vy are ignored. '#' begins a comment; values
// may be inf or nan.
struct Lights {
    std::vector<LightPoint> points;  // in pixels of the data window
    bool has_depth = false;          // false: radii
};
// Errors: InvalidFile with the path and the line (missing, no header, a column missing, twice or unknown, a
// value missing, too many, or not a number).
PETZVAL_API Result<Lights> read_lights(const std::string& path, const Rect& data_window);
// The text of such a file for lights with depth; read_lights() reads back the same floats. `comment`: lines
// without '#'.
PETZVAL_API std::string lights_text(const std::vector<LightPoint>& points,
                                    const std::vector<std::string>& comment);

// Reads the pictures that a look names (aperture_image, kernel_image_far, kernel_image_near) into its lens.
// Errors: those of read_png() and read_frame(), with the field before the file.
PETZVAL_API Status read_lens_images(Look& look, int threads = 0);

}  // namespace petzval
