#include "files/raster/raster.h"

#include "petzval/develop.h"
#include "petzval/names.h"

#include "files/exr/pixels.h"
#include "files/exr/prescan.h"
#include "files/exr/read.h"
#include "files/memory_limit.h"
#include "files/raster/raster_tags.h"
#include "files/wording.h"

#include <algorithm>
#include <array>

namespace petzval {
namespace {

constexpr std::array kFormats{
    RasterFormat{"PNG", "png", starts_like_png, read_png_raster},
#ifdef PETZVAL_JPEG
    RasterFormat{"JPEG", "jpeg", starts_like_jpeg, read_jpeg},
#endif
#ifdef PETZVAL_TIFF
    RasterFormat{"TIFF", "tiff", starts_like_tiff, read_tiff},
#endif
};

// Layers, views and channels are an EXR's; depth is another file's.
Status check_asked(const InputFile& file, const std::string& a_format, const ReadOptions& options,
                   bool pixels) {
    const std::string path = printable(file.path(), 4096);
    if (const std::string& asked = options.layer.empty() ? options.view_name : options.layer; !asked.empty())
        return Error{ErrorCode::InvalidArgument,
                     path + ": " + a_format + " has no layer or view '" + printable(asked) + "'"};
    if (!options.layers.empty())
        return Error{ErrorCode::InvalidArgument, "read.layers is for EXR; " + path + " is " + a_format,
                     "read.layers"};
    if (options.depth_file.empty() && (options.need_depth || !options.depth_channel.empty()) && pixels)
        return invalid_file(file.path(), "has no depth channel; " + a_format +
                                             " needs another file that holds the depth (read.depth_file)");
    return Done{};
}

std::string line_of(const RasterFormat& format, const Raster& raster, Transfer transfer) {
    const std::string bits = std::to_string(raster.bits) + " bit";
    const std::string colour = std::string("colour: ") + format.name + ", " + bits;
    if (raster.is_float()) return colour + " float, linear light";
    std::string curve;
    for (const auto& known : names<Transfer>())
        if (known.value == transfer) curve = known.meaning;
    return colour + ", decoded through " + curve + "; 1.0 is clipped highlights";
}

Picture light_of_codes(const Raster& raster, Transfer transfer) {
    std::vector<float> linear(raster.bits == 16 ? 65536 : 256);
    const double white = double(linear.size() - 1);
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = float(decode(transfer, double(i) / white));
    // Codes that were multiplied by alpha are codes again when divided by it.
    const auto light = [&](std::uint16_t code, std::uint16_t alpha) {
        if (!raster.premultiplied || alpha == 0) return linear[code];
        return float(decode(transfer, std::min(1.0, double(code) / double(alpha))));
    };
    Picture colour = Picture::uninitialised(raster.width, raster.height);
    const std::ptrdiff_t step = raster.channels == 1 ? 0 : 1;
    for (std::size_t i = 0; i < colour.size(); ++i) {
        const std::uint16_t* s = raster.codes.data() + i * std::size_t(raster.channels);
        const std::uint16_t alpha = raster.channels == 4 ? s[3] : std::uint16_t(white);
        const float a = raster.channels == 4 ? float(alpha) / float(white) : 1.f;
        colour.pixels()[i] = {light(s[0], alpha) * a, light(s[step], alpha) * a,
                              light(s[2 * step], alpha) * a, a};
    }
    return colour;
}

Picture light_of_floats(const Raster& raster, std::size_t& non_finite) {
    Picture colour = Picture::uninitialised(raster.width, raster.height);
    const std::ptrdiff_t step = raster.channels == 1 ? 0 : 1;
    for (std::size_t i = 0; i < colour.size(); ++i) {
        const float* s = raster.floats.data() + i * std::size_t(raster.channels);
        Rgba c{s[0], s[step], s[2 * step], raster.channels == 4 ? s[3] : 1.f};
        for (float* v : {&c.r, &c.g, &c.b, &c.a}) non_finite += made_finite(*v);
        const float a = raster.premultiplied ? 1.f : c.a;
        colour.pixels()[i] = {c.r * a, c.g * a, c.b * a, c.a};
    }
    return colour;
}

Frame header_of(const RasterFormat& format, const Raster& raster, Transfer transfer) {
    Frame frame;
    frame.place = Place::whole(raster.rect());
    frame.has_alpha = raster.channels == 4;
    frame.code_bits = raster.is_float() ? 0 : raster.bits;
    frame.parts.push_back({"", format.type, "", raster.compression, frame.place.data_window, {}});
    const std::string kind = raster.is_float() ? " float" : " " + std::to_string(raster.bits) + " bit";
    for (int c = 0; c < raster.channels; ++c)
        frame.parts[0].channels.push_back(
            (raster.channels == 1 ? "Y" : std::string("RGBA").substr(std::size_t(c), 1)) + kind);
    frame.detected.push_back(line_of(format, raster, transfer));
    if (!raster.note.empty()) frame.detected.push_back(raster.note);
    return frame;
}

}  // namespace

const RasterFormat* raster_format_of(const InputFile& file) {
    const auto* found =
        std::find_if(kFormats.begin(), kFormats.end(), [&](const auto& f) { return f.starts_like(file); });
    return found == kFormats.end() ? nullptr : found;
}

std::string raster_formats() {
    std::string all;
    for (const RasterFormat& format : kFormats) all += (all.empty() ? "" : ", ") + std::string(format.name);
    return all;
}

Result<Raster> read_raster(const InputFile& file, const RasterFormat& format, const ReadOptions& options,
                           std::size_t of_pixel) {
    if (options.max_memory_bytes > 0) {
        const Result<Raster> header = format.read(file, options, false);
        if (!header) return header;
        const std::size_t sample = header->is_float() ? sizeof(float) : sizeof(std::uint16_t);
        of_pixel += std::size_t(header->channels) * sample + header->more_bytes_per_pixel;
        const std::size_t turned = header->orientation == 1 ? 0 : std::size_t(header->channels) * sample;
        if (Status fits = fits_memory(file, header->rect(), of_pixel + turned, options); !fits)
            return fits.error();
    }
    Result<Raster> raster = format.read(file, options, true);
    return raster ? upright(std::move(*raster)) : std::move(raster);
}

Result<Frame> read_raster_frame(const std::shared_ptr<const InputFile>& file, const RasterFormat& format,
                                const ReadOptions& options, bool pixels) {
    if (Status fine = check_asked(*file, std::string("a ") + format.name, options, pixels); !fine)
        return fine.error();
    Result<Raster> raster =
        pixels ? read_raster(*file, format, options, sizeof(Rgba)) : format.read(*file, options, false);
    if (!raster) return raster.error();
    if (!pixels) *raster = upright(std::move(*raster));
    Frame frame = header_of(format, *raster, options.transfer);
    if (!pixels) return frame;
    frame.colour = raster->is_float() ? light_of_floats(*raster, frame.non_finite_colour)
                                      : light_of_codes(*raster, options.transfer);
    const auto is_clear = [](const Rgba& c) { return c.a == 0; };
    if (frame.has_alpha &&
        std::all_of(frame.colour.pixels(), frame.colour.pixels() + frame.colour.size(), is_clear))
        frame.warnings.emplace_back("its alpha is 0 in every pixel, as if the picture were empty");
    if (!options.depth_file.empty())
        if (Status s = take_depth_file(options, frame); !s) return s.error();
    return frame;
}

}  // namespace petzval
