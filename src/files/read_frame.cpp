#include "petzval/files.h"

#include "base/parallel.h"
#include "files/exr/pixels.h"
#include "files/exr/prescan.h"
#include "files/exr/read.h"
#include "files/raster/raster.h"
#include "files/wording.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval {
namespace {

Error unknown_format(const InputFile& file) {
    return invalid_file(file.path(), "is not a picture that can be read (OpenEXR, " + raster_formats() +
                                         "), despite its file name");
}

Result<Frame> read(const std::string& path, ReadOptions options, bool pixels) {
    const std::shared_ptr<Workers> workers = workers_of(options.threads, options.workers);
    options.workers = workers.get();
    const auto file = InputFile::open_or_wait(path, *workers, options.max_memory_bytes);
    if (!file) return file.error();
    std::optional<Result<Frame>> frame;
    // The room's door: whatever libraries threw and nobody caught further in stops here.
    const Status sound = guarded(**file, [&]() -> Status {
        if (starts_like_exr(**file))
            frame = read_exr_frame(*file, options, pixels);
        else if (const RasterFormat* format = raster_format_of(**file))
            frame = read_raster_frame(*file, *format, options, pixels);
        else
            frame = unknown_format(**file);
        return frame->has_value() ? Status(Done{}) : frame->error();
    });
    if (!sound) return sound.error();
    return std::move(*frame);
}

// Whole numbers as shares of full scale, never through a transfer curve; floats as they are.
Plane first_channel(const Raster& r) {
    Plane out = Plane::uninitialised(r.width, r.height);
    const float full = r.bits == 16 ? 65535.f : 255.f;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t at = i * std::size_t(r.channels);
        out.pixels()[i] = r.is_float() ? r.floats[at] : float(r.codes[at]) / full;
    }
    return out;
}

std::string size_of(const Rect& r) { return std::to_string(r.width()) + " x " + std::to_string(r.height()); }

// Positions of pixel centres from … to - 1 on a line of `stored` values that is stretched over `size` pixels
// from `origin` on: the two values around each, and the fraction between them.
struct Between {
    int first = -1, second = -1;  // -1: outside
    float share = 0;
};

std::vector<Between> stretched(int from, int to, int origin, int size, int stored) {
    std::vector<Between> all;
    for (int i = from; i < to; ++i) {
        if (i < origin || i >= origin + size) {
            all.emplace_back();
            continue;
        }
        const double at = (double(i - origin) + 0.5) * double(stored) / double(size);
        const auto clamped = [&](double place) { return std::clamp(int(std::floor(place)), 0, stored - 1); };
        if (stored < size)
            all.push_back({clamped(at - 0.5), clamped(at + 0.5), float(at - 0.5 - std::floor(at - 0.5))});
        else
            all.push_back({clamped(at), clamped(at), 0});
    }
    return all;
}

// Depth that covers the display window, whatever its size: the nearest value each, as a mean of two depths
// lies where nothing is. Shares of full scale are mostly of networks, whose silhouettes are ramps anyhow:
// smaller maps of those are a line between values, and each pixel goes to one side by the picture's colours
// (DepthEdges); in blocks it would keep their steps.
Plane depth_over(const Rect& display, const Plane& depth, bool shares, const Rect& data) {
    const auto columns = stretched(data.x0, data.x1, display.x0, display.width(), depth.width());
    const auto rows = stretched(data.y0, data.y1, display.y0, display.height(), depth.height());
    const auto mix = [shares](float a, float b, float share) {
        return shares ? a + (b - a) * share : share < 0.5f ? a : b;
    };
    Plane out(data.width(), data.height(), std::numeric_limits<float>::infinity());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) {
            const Between &c = columns[std::size_t(x)], &r = rows[std::size_t(y)];
            if (c.first < 0 || r.first < 0) continue;
            out(x, y) = mix(mix(depth(c.first, r.first), depth(c.second, r.first), c.share),
                            mix(depth(c.first, r.second), depth(c.second, r.second), c.share), r.share);
        }
    return out;
}

// The note about a map of another size; empty if the size fits.
std::string resampled(const Rect& theirs, const Rect& display, bool shares) {
    if (theirs.width() == display.width() && theirs.height() == display.height()) return "";
    const bool lines = shares && theirs.width() < display.width();
    return "; " + size_of(theirs) + " for " + size_of(display) +
           (lines ? ", a line between its values" : ", the nearest value each");
}

void warn_of_shape(const std::string& path, const Rect& theirs, const Rect& display, DepthOfFile& into) {
    const double shape =
        double(theirs.width()) * display.height() / (double(theirs.height()) * display.width());
    if (std::abs(shape - 1) > 0.02)
        into.warnings.push_back("depth of " + printable(path) + " has another shape, " + size_of(theirs) +
                                " for " + size_of(display) +
                                ", and is stretched: it may be cropped or turned");
}

// Maps of depth as colours (false colours, or bytes of one number) have no depth in their first channel.
// Grey saved as JPEG differs by a few codes between channels.
bool is_coloured(const Raster& r) {
    constexpr double kGrey = 0.02;  // of full scale, in the mean
    if (r.channels < 3 || r.is_float() || r.codes.empty()) return false;
    double differences = 0;
    for (std::size_t i = 0; i < r.codes.size(); i += std::size_t(r.channels))
        differences += std::max(std::abs(r.codes[i] - r.codes[i + 1]), std::abs(r.codes[i] - r.codes[i + 2]));
    const double pixels = double(r.codes.size()) / r.channels;
    return differences > kGrey * (r.bits == 16 ? 65535 : 255) * pixels;
}

Status take_raster(const InputFile& file, const RasterFormat& format, const ReadOptions& options,
                   const Place& place, DepthOfFile& into) {
    const Result<Raster> raster = read_raster(file, format, options, sizeof(float));
    if (!raster) return raster.error();
    into.is_share = !raster->is_float();
    into.depth = first_channel(*raster);
    const bool fits_data = place.fits(raster->width, raster->height);
    into.detected.push_back(
        "depth: " + printable(file.path()) + ", " + std::to_string(raster->bits) + " bit" +
        (raster->is_float() ? " float" : " as a share of full scale, never sRGB-decoded") +
        (fits_data ? "" : resampled(raster->rect(), place.display_window, into.is_share)));
    if (is_coloured(*raster))
        into.warnings.push_back("depth of " + printable(file.path()) +
                                " has colours: only its red channel is read, which false colours and "
                                "packed bytes do not keep in order");
    if (fits_data) return Done{};
    warn_of_shape(file.path(), raster->rect(), place.display_window, into);
    into.depth = depth_over(place.display_window, into.depth, into.is_share, place.data_window);
    return Done{};
}

// Depth of an EXR over `window` of its frame.
struct DepthOfExr {
    Plane depth;
    Rect window, display;
    std::string line;
    bool is_colour = false;
};

// A file of deep samples only: the depth of their front view.
Result<DepthOfExr> depth_of_samples(const std::shared_ptr<const InputFile>& file, ReadOptions options) {
    options.depth_file.clear();
    options.need_colour = false;
    auto frame = read_exr_frame(file, options, true);
    if (!frame) return frame.error();
    return DepthOfExr{std::move(frame->depth), frame->place.data_window, frame->place.display_window,
                      "depth: front view of the deep samples"};
}

Result<DepthOfExr> depth_of_exr(const std::shared_ptr<const InputFile>& file, const ReadOptions& options) {
    Result<ExrFile> exr = ExrFile::open(file, options.max_pixels, *options.workers);
    if (!exr) return exr.error();
    const auto& parts = exr->layout.parts;
    if (std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.deep; }))
        return depth_of_samples(file, options);
    const Result<DepthChoice> choice =
        choose_depth(file->path(), exr->layout, nullptr, options, has_camera_matrix(*exr));
    if (!choice) return choice.error();
    Result<Plane> depth = read_depth(*exr, *choice);
    if (!depth) return depth.error();
    return DepthOfExr{std::move(*depth), parts[choice->part].data_window, exr->layout.display_window,
                      choice->line, choice->is_colour};
}

Status take_exr(const std::shared_ptr<const InputFile>& file, const ReadOptions& options, const Place& place,
                DepthOfFile& into) {
    Result<DepthOfExr> exr = depth_of_exr(file, options);
    if (!exr) return exr.error();
    const Rect& display = place.display_window;
    const std::string other_size = resampled(exr->display, display, false);
    warn_of_shape(file->path(), exr->display, display, into);
    into.is_colour = exr->is_colour;
    into.detected.push_back(exr->line + ", in " + printable(file->path()) + other_size);
    // Display windows lie on each other, wherever they begin.
    const int right = display.x0 - exr->display.x0, down = display.y0 - exr->display.y0;
    const Rect window = exr->window.moved(right, down);
    const Rect covered = other_size.empty() ? place.data_window : exr->display.moved(right, down);
    note_missing_depth(window, covered, into.detected);
    if (window != covered) exr->depth = pasted(exr->depth, window, covered);
    into.depth = other_size.empty() ? std::move(exr->depth)
                                    : depth_over(display, exr->depth, false, place.data_window);
    return Done{};
}

}  // namespace

Result<Frame> read_frame(const std::string& path, const ReadOptions& options) {
    return read(path, options, true);
}

Result<Frame> read_frame_header(const std::string& path, const ReadOptions& options) {
    return read(path, options, false);
}

Result<DepthOfFile> read_depth_file(const ReadOptions& options, const Place& place) {
    const std::shared_ptr<Workers> workers = workers_of(options.threads, options.workers);
    ReadOptions with_workers = options;
    with_workers.workers = workers.get();
    const auto file = InputFile::open_or_wait(options.depth_file, *workers, options.max_memory_bytes);
    if (!file) return file.error();
    DepthOfFile read;
    const Status taken = guarded(**file, [&]() -> Status {
        if (const RasterFormat* format = raster_format_of(**file))
            return take_raster(**file, *format, with_workers, place, read);
        if (!starts_like_exr(**file)) return unknown_format(**file);
        return take_exr(*file, with_workers, place, read);
    });
    if (!taken) return taken.error();
    return read;
}

Status take_depth_file(const ReadOptions& options, Frame& frame) {
    auto read = read_depth_file(options, frame.place);
    if (!read) return read.error();
    frame.depth = std::move(read->depth), frame.depth_is_share = read->is_share;
    for (std::string& line : read->detected) frame.detected.push_back(std::move(line));
    for (std::string& line : read->warnings) frame.warnings.push_back(std::move(line));
    return Done{};
}

}  // namespace petzval
