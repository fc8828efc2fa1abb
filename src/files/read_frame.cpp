#include "petzval/develop.h"
#include "petzval/files.h"
#include "petzval/names.h"

#include "base/parallel.h"
#include "files/exr_pixels.h"
#include "files/exr_prescan.h"
#include "files/exr_read.h"
#include "files/memory_limit.h"
#include "files/png.h"
#include "files/wording.h"

#include <cmath>
#include <limits>

namespace petzval {
namespace {

Error neither(const InputFile& file) {
    return invalid_file(file.path(), "is neither an OpenEXR nor a PNG file, whatever its name says");
}

Result<Frame> read(const std::string& path, ReadOptions options, bool pixels) {
    const auto file = InputFile::open(path);
    if (!file) return file.error();
    const std::shared_ptr<Workers> workers = workers_of(options.threads, options.workers);
    options.workers = workers.get();
    std::optional<Result<Frame>> frame;
    // The room's door: whatever libraries threw and nobody caught further in stops here.
    const Status sound = guarded(path, [&]() -> Status {
        if (starts_like_exr(**file))
            frame = read_exr_frame(*file, options, pixels);
        else if (starts_like_png(**file))
            frame = read_png_frame(*file, options, pixels);
        else
            frame = neither(**file);
        return Done{};
    });
    if (!sound) return sound.error();
    return std::move(*frame);
}

// The share of full scale, never through a transfer curve.
Plane first_channel(const PngPixels& p) {
    Plane out = Plane::uninitialised(p.width, p.height);
    const float full = p.bits == 16 ? 65535.f : 255.f;
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels()[i] = float(p.samples[i * std::size_t(p.channels)]) / full;
    return out;
}

std::string size_of(const Rect& r) { return std::to_string(r.width()) + " x " + std::to_string(r.height()); }

// Depth that covers the display window, whatever its size: the nearest value, as means of two depths lie
// where nothing is.
Plane nearest_in(const Plane& depth, const Rect& display, const Rect& data) {
    const auto places = [](int from, int to, int origin, int size, int stored) {
        std::vector<int> at;
        for (int i = from; i < to; ++i)
            at.push_back(i < origin || i >= origin + size
                             ? -1
                             : int((double(i - origin) + 0.5) * double(stored) / double(size)));
        return at;
    };
    const auto columns = places(data.x0, data.x1, display.x0, display.width(), depth.width());
    const auto rows = places(data.y0, data.y1, display.y0, display.height(), depth.height());
    Plane out(data.width(), data.height(), std::numeric_limits<float>::infinity());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            if (rows[std::size_t(y)] >= 0 && columns[std::size_t(x)] >= 0)
                out(x, y) = depth(columns[std::size_t(x)], rows[std::size_t(y)]);
    return out;
}

// What is said of a map of another size; nothing for one that fits.
std::string resampled(const Rect& theirs, const Rect& display) {
    if (theirs.width() == display.width() && theirs.height() == display.height()) return "";
    const double shape =
        double(theirs.width()) * display.height() / (double(theirs.height()) * display.width());
    return "; " + size_of(theirs) + " for " + size_of(display) + ", the nearest value each" +
           (std::abs(shape - 1) > 0.02 ? ", of another shape: stretched" : "");
}

Result<Plane> depth_of_png(const InputFile& file, std::size_t max_pixels, const Place& place,
                           std::vector<std::string>& detected) {
    const Result<PngPixels> png = read_png_file(file, max_pixels);
    if (!png) return png.error();
    const Rect size{0, 0, png->width, png->height}, &display = place.display_window;
    Plane depth = first_channel(*png);
    const bool fits_data = place.fits(size.width(), size.height());
    detected.push_back("depth: " + printable(file.path()) + ", " + std::to_string(png->bits) +
                       " bit as a share of full scale, never sRGB-decoded" +
                       (fits_data ? "" : resampled(size, display)));
    if (fits_data) return depth;
    return nearest_in(depth, display, place.data_window);
}

Result<Plane> depth_of_exr(const std::shared_ptr<const InputFile>& file, const ReadOptions& options,
                           const Place& place, std::vector<std::string>& detected) {
    Result<ExrFile> exr = ExrFile::open(file, options.max_pixels, *options.workers);
    if (!exr) return exr.error();
    const Rect theirs = exr->layout.display_window, &display = place.display_window;
    const Result<DepthChoice> choice = choose_depth(file->path(), exr->layout, nullptr, options, false);
    if (!choice) return choice.error();
    const std::string other_size = resampled(theirs, display);
    detected.push_back(choice->line + ", in " + printable(file->path()) + other_size);
    Result<Plane> depth = read_depth(*exr, *choice);
    if (!depth) return depth.error();
    const Rect window = exr->layout.parts[choice->part].data_window;
    if (!other_size.empty()) {
        if (window != theirs) *depth = pasted(*depth, window, theirs);
        return nearest_in(*depth, display, place.data_window);
    }
    return window == place.data_window ? std::move(*depth) : pasted(*depth, window, place.data_window);
}

}  // namespace

Result<Frame> read_frame(const std::string& path, const ReadOptions& options) {
    return read(path, options, true);
}

Result<Frame> read_frame_header(const std::string& path, const ReadOptions& options) {
    return read(path, options, false);
}

Status read_depth_file(const ReadOptions& options, Frame& frame) {
    const auto file = InputFile::open(options.depth_file);
    if (!file) return file.error();
    frame.depth_is_share = starts_like_png(**file);
    if (!frame.depth_is_share && !starts_like_exr(**file)) return neither(**file);
    auto depth = frame.depth_is_share ? depth_of_png(**file, options.max_pixels, frame.place, frame.detected)
                                      : depth_of_exr(*file, options, frame.place, frame.detected);
    if (!depth) return depth.error();
    frame.depth = std::move(*depth);
    return Done{};
}

Result<Frame> read_png_frame(const std::shared_ptr<const InputFile>& file, const ReadOptions& options,
                             bool pixels) {
    if (pixels && options.max_memory_bytes > 0) {
        const Result<PngPixels> size = read_png_size(*file, options.max_pixels);
        if (!size) return size.error();
        const std::size_t of_pixel = sizeof(Rgba) + 4 * sizeof(std::uint16_t);  // as decoded, too
        if (Status s = fits_memory(*file, {0, 0, size->width, size->height}, of_pixel, options); !s)
            return s.error();
    }
    const Result<PngPixels> png =
        pixels ? read_png_file(*file, options.max_pixels) : read_png_size(*file, options.max_pixels);
    if (!png) return png.error();
    for (const std::string* asked : {&options.layer, &options.view_name})
        if (!asked->empty())
            return Error{
                ErrorCode::InvalidArgument,
                printable(file->path(), 4096) + ": a PNG has no layer or view '" + printable(*asked) + "'"};
    if (!options.layers.empty())
        return Error{ErrorCode::InvalidArgument,
                     "read.layers is for EXR; " + printable(file->path(), 4096) + " is a PNG", "read.layers"};
    Frame frame;
    frame.place = Place::whole({0, 0, png->width, png->height});
    frame.has_alpha = png->channels == 4;
    frame.display_referred = true;
    frame.parts.push_back({"", "png", "", "zip", frame.place.data_window, {}});
    const std::string bits = std::to_string(png->bits) + " bit";
    for (int c = 0; c < png->channels; ++c)
        frame.parts[0].channels.push_back(
            std::string(png->channels == 1 ? "Y" : std::string("RGBA").substr(std::size_t(c), 1)) + " " +
            bits);
    std::string curve;
    for (const auto& known : names<Transfer>())
        if (known.value == options.transfer) curve = known.meaning;
    frame.detected.push_back("colour: PNG, " + bits + ", decoded through " + curve +
                             "; 1.0 is clipped highlights");
    if (options.depth_file.empty() && (options.need_depth || !options.depth_channel.empty()) && pixels)
        return invalid_file(file->path(),
                            "has no depth channel; a PNG needs a depth file, read.depth_file FILE");
    if (!pixels) return frame;

    std::vector<float> linear(png->bits == 16 ? 65536 : 256);
    for (std::size_t i = 0; i < linear.size(); ++i)
        linear[i] = float(decode(options.transfer, double(i) / double(linear.size() - 1)));
    frame.colour = Picture::uninitialised(png->width, png->height);
    for (std::size_t i = 0; i < frame.colour.size(); ++i) {
        const std::uint16_t* s = png->samples.data() + i * std::size_t(png->channels);
        const float a = frame.has_alpha ? float(s[3]) / float(linear.size() - 1) : 1.f;
        const std::ptrdiff_t step = png->channels == 1 ? 0 : 1;
        frame.colour.pixels()[i] = {linear[s[0]] * a, linear[s[step]] * a, linear[s[2 * step]] * a, a};
    }
    if (!options.depth_file.empty())
        if (Status s = read_depth_file(options, frame); !s) return s.error();
    return frame;
}

}  // namespace petzval
