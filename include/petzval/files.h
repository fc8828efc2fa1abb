// Files: EXR through OpenEXR, PNG through libpng. Optional component petzval::files.
#pragma once

#include "petzval/deep.h"
#include "petzval/depth.h"
#include "petzval/develop.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/light_spectrum.h"
#include "petzval/motion.h"
#include "petzval/output.h"
#include "petzval/place.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// The parts of a file that are read, and their meaning. An empty string means that the reader detects the
// value and reports it with the reason.
struct ReadOptions {
    std::string layer;                   // colour layer or part, e.g. "ViewLayer.Combined" or "rgba_right"
    std::string view_name;               // stereo view, e.g. "left"
    std::string depth_file;              // another file that holds the depth
    std::string depth_channel;           // e.g. "Z", "depth.R", "ViewLayer.Depth.Z"
    Transfer transfer = Transfer::Srgb;  // decodes PNG colour; EXR is linear by definition
    // Layers that are blurred with the colour: "all", and names of layers, parts or single channels;
    // "-NAME" after "all" omits one, "NAME:LAMP" sets the spectrum of its light, as "signs:neon". Empty:
    // none. EXR only.
    std::vector<std::string> layers;
    bool need_colour = true;    // false: alpha and depth are enough, as for a matte; colour is then 0
    bool need_depth = true;     // false: a file without depth is accepted, depth stays empty
    MotionReading motion = {};  // EXR only; not of deep parts
    std::size_t max_pixels = std::size_t(1) << 28;  // larger data windows are refused before memory is taken
    // Memory limit for the pixels of a frame: a larger frame is refused before memory is taken, deep samples
    // as soon as they are counted. 0: no limit.
    std::size_t max_memory_bytes = 0;
    int threads = 0;  // 0: all this process may use; the result never depends on it.
                      // OpenEXR decodes on its own pool, of as many threads; for 1 that stays empty
    Workers* workers = nullptr;  // those of a host, in place of `threads`; null: our own
};

// A camera number found in a file, in petzval's unit, and where it came from ("Redshift rs/camera/FStop").
struct FoundNumber {
    double value = 0;
    std::string origin;
    bool scene_units = false;  // a distance in the renderer's unit: multiply by the metres per unit
};

struct FoundCamera {
    std::optional<FoundNumber> focal_length_mm, sensor_width_mm, f_number, focus_distance_m;
    // Set if a file gives it; with one of focal length and sensor width known, the other follows (and is
    // filled in if the file holds both).
    std::optional<FoundNumber> horizontal_fov_deg;
    // The file's worldToCamera, rows one after the other: a world point as row vector (x, y, z, 1) times
    // this matrix is the point in camera space, in scene units; OpenEXR's camera looks along +z.
    std::optional<std::array<double, 16>> camera_from_world = std::nullopt;
};

// One part of a file, as `inspect` lists it.
struct PartSummary {
    std::string name, type, view,
        compression;  // type: scanlineimage, tiledimage, deepscanline, deeptile, png
    Rect data_window;
    std::vector<std::string> channels;  // "R half", "Z float", …
};

// Another layer of the colour's surfaces, with its data window: a colour layer, or up to three single
// channels as red, green and blue. Layers of a file stand in the order in which write_exr() finds them again.
struct FrameLayer {
    std::vector<std::string> names;  // one of a colour, else one for each channel
    Picture colour;                  // alpha: that of the frame's colour
    bool is_light = false;           // as in ColourLayer
    std::optional<LightSpectrum> spectrum = {};
};

// A layer or channel that is copied, and the reason: this one if it could be blurred on request.
inline constexpr const char* kNotAskedFor = "not asked for";
struct CarriedLayer {
    std::string name, why;
};

// Everything in a file that petzval does not process but writes back (attributes, other channels,
// parts).
class CarriedContent;

// A picture with its depth and its place in the frame.
struct Frame {
    Place place;
    Picture colour;          // size of the data window; scene-linear Rec.709, premultiplied
    bool has_alpha = false;  // false: colour.a is 1 everywhere
    // Size of the data window, values as stored (see depth_to_planar_metres), +infinity where a depth part
    // with another window has no pixels; may be empty.
    Plane depth;
    MotionVectors motion;         // of the data window, as ReadOptions::motion asks
    bool depth_is_share = false;  // read from whole numbers: shares of full scale, 0…1
    // All samples of a deep input with depths as stored (see deep_to_planar_metres), else empty. colour and
    // depth are then its front view: composited samples, and the depth at which coverage first reaches half
    // of the pixel's, so a wall behind thin fog keeps its depth.
    DeepPicture deep;
    std::vector<FrameLayer> layers;            // as ReadOptions::layers asks
    std::vector<CarriedLayer> layers_carried;  // all others
    FoundCamera camera;
    std::vector<std::string> views;  // of a stereo file, in its order; empty for others
    std::string view;                // that of the colour
    // History of the colour's part, a line per step, oldest first (attribute petzval:history), and the
    // first channel of the colour, its name in the history.
    std::string history, colour_name;
    // 8 or 16: read from display codes of so many bits, whose 1.0 is clipped highlights; 0: light.
    int code_bits = 0;
    bool display_referred() const { return code_bits > 0; }
    std::size_t non_finite_colour =
        0;  // NaN or infinite colour values that were replaced by 0 or the largest half
    std::vector<PartSummary> parts;
    std::vector<std::string> detected;  // one line for each automatic choice, with its source and reason
    std::vector<std::string> warnings;
    std::shared_ptr<const CarriedContent> carried;
};

// Reads .exr (flat, tiled, multi-part, multi-view, deep), .png and, where their libraries
// were found, .jpg and .tif, decided by content, not by name. "-" is standard input, once
// and into memory: 4 GiB at most, or max_memory_bytes. Errors: InvalidFile (missing,
// damaged, truncated, empty, no colour, no depth when needed, larger than max_pixels),
// InvalidArgument (the file does not have that layer, view or channel; the message lists
// those it has).
PETZVAL_API Result<Frame> read_frame(const std::string& path, const ReadOptions& options = {});

// Header only: parts, channels, windows, camera; pixels stay unread.
PETZVAL_API Result<Frame> read_frame_header(const std::string& path, const ReadOptions& options = {});

// Depth from a separate file, for a picture that a host holds.
struct DepthOfFile {
    Plane depth;                        // as Frame::depth
    bool is_share = false;              // as Frame::depth_is_share
    bool is_colour = false;             // no channel of an EXR is named like depth: its first colour channel
    std::vector<std::string> detected;  // as Frame::detected; the first one names the channel of an EXR
    std::vector<std::string> warnings;  // about maps of another shape, and coloured ones
};
// Reads options.depth_file, in any format of read_frame(), over the data window of `place`. A map of another
// size is stretched over the display window: to the nearest value, or as lines between the values of smaller
// maps of whole numbers. Errors: those of read_frame().
PETZVAL_API Result<DepthOfFile> read_depth_file(const ReadOptions& options, const Place& place);

// The text attribute of an EXR, or the text of a PNG with that keyword; empty if there is none. Errors:
// InvalidFile.
PETZVAL_API Result<std::string> read_text_attribute(const std::string& path, const std::string& name);

enum class PixelType { Keep, Half, Float };

// Changes that writing had to make, for a log.
struct WriteReport {
    std::size_t clamped_to_half = 0;  // finite colour values beyond 65504, written as 65504
    std::size_t non_finite = 0;       // NaN written as 0, infinities as 65504
    bool became_rgb = false;          // luminance (Y) is not grey any more, or had chroma: written as R, G, B
};

struct WriteOptions {
    PixelType type = PixelType::Keep;  // Keep: as the carried input had it, else half
    // none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab; empty: as the input, else zip. If the
    // input's compression would degrade carried channels again, the file is written as zip.
    std::string compression;
    bool overwrite = true;  // false: an existing file is an OutputFailed error
    // Extra attributes, e.g. {"petzval:coc", "signed radius, px, + is far"}.
    std::vector<std::pair<std::string, std::string>> attributes;
    // Camera numbers as typed attributes (focal length, sensor, aperture, focus, worldToCamera), where known.
    FoundCamera camera;
    WriteReport* report = nullptr;  // filled when given
    int threads = 0;                // as in ReadOptions
    Workers* workers = nullptr;
};

// Replaces colour (and alpha when has_alpha) of the carried part by frame.colour and the channels of its
// layers by those, keeps every other channel, part and attribute, and writes a flat EXR. If frame.depth is
// not empty and nothing is carried, it is written as float Z, and its motion as forward.u, forward.v,
// backward.u and backward.v, y upwards. The file is written beside `path`, synced and renamed, so `path` is
// either complete or unchanged.
//
// Carried channels are copied bit for bit from the input, which must not have changed. Where the frame's
// data window is larger than the input's, they are 0 (depth: +infinity). Colour goes back to the primaries
// of the input. Mip levels below the first are dropped. Errors: InvalidArgument (sizes that do not match,
// an unknown compression), InvalidFile (the input changed), OutputFailed.
PETZVAL_API Status write_exr(const std::string& path, const Frame& frame, const WriteOptions& options = {});

// The same for several views of one file, each read separately: the colour and layers of all are replaced.
// Views in one part need one data window. Errors: those of write_exr(); InvalidArgument for frames that
// were not read from a file.
PETZVAL_API Status write_exr_views(const std::string& path, const std::vector<const Frame*>& frames,
                                   const WriteOptions& options = {});

// Planes under channel names, float, one part: circle of confusion, depth, bokeh textures.
struct NamedPlane {
    std::string channel;
    View<const float> plane;
};
PETZVAL_API Status write_exr_planes(const std::string& path, const Place& place,
                                    const std::vector<NamedPlane>& planes, const WriteOptions& options = {});

// A deep scanline EXR: half R, G, B, A (float with PixelType::Float) and float Z, ZBack (left out where no
// sample has a thickness). Compression none, rle or zips, the only ones for deep files; empty: zips.
PETZVAL_API Status write_deep_exr(const std::string& path, const Place& place, const DeepPicture& deep,
                                  const WriteOptions& options = {});

// Refuses work of known size before it begins. what: such as "a picture of 640 x 360"; limit_bytes 0: no
// limit. Errors: OutOfMemory, as for ReadOptions::max_memory_bytes.
PETZVAL_API Status fits_memory(const std::string& what, std::size_t needed_bytes, std::size_t limit_bytes);

// 8 or 16 bit PNG of display-referred bytes already encoded (see develop.h). channels: 1, 3 or 4,
// interleaved.
struct PngPixels {
    int width = 0, height = 0, channels = 3, bits = 8;
    std::vector<std::uint16_t> samples;  // 0…255 or 0…65535
    double pixel_aspect = 1;             // width / height of a pixel; written, not read
    // Keywords, of 1 to 79 letters, and their texts, ASCII; written, and read by read_text_attribute().
    std::vector<std::pair<std::string, std::string>> texts = {};
};
PETZVAL_API Status write_png(const std::string& path, const PngPixels& pixels, bool overwrite = true);
// The same file as bytes, for pages and mails with embedded pictures.
PETZVAL_API Result<std::string> png_bytes(const PngPixels& pixels);
// Samples as stored, never transfer-decoded: masks, depth PNGs, aperture images.
PETZVAL_API Result<PngPixels> read_png(const std::string& path, std::size_t max_pixels = std::size_t(1)
                                                                                         << 28);

}  // namespace petzval
