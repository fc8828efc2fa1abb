#ifdef PETZVAL_TIFF

#include "base/cancel.h"
#include "files/raster/raster_tags.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <tiffio.h>

#include <Imath/half.h>

namespace petzval {
namespace {

struct Source {
    const InputFile& file;
    std::uint64_t position = 0;
    std::array<char, 256> message{};  // the first, which is the cause
};

tmsize_t on_read(thandle_t handle, void* to, tmsize_t bytes) {
    auto& source = *static_cast<Source*>(handle);
    const std::uint64_t end = source.file.bytes(), from = std::min(source.position, end);
    const auto count = std::size_t(std::min<std::uint64_t>(std::uint64_t(bytes), end - from));
    if (!source.file.read_at(from, to, count)) return -1;
    source.position = from + count;
    return tmsize_t(count);
}

toff_t on_seek(thandle_t handle, toff_t offset, int whence) {
    auto& source = *static_cast<Source*>(handle);
    source.position = offset + (whence == SEEK_CUR   ? source.position
                                : whence == SEEK_END ? source.file.bytes()
                                                     : 0);
    return source.position;
}

tmsize_t on_write(thandle_t, void*, tmsize_t) { return -1; }
int on_close(thandle_t) { return 0; }
toff_t on_size(thandle_t handle) { return static_cast<Source*>(handle)->file.bytes(); }

int on_error(TIFF*, void* user, const char*, const char* format, va_list values) {
    auto& message = static_cast<Source*>(user)->message;
    if (message[0] == 0) std::vsnprintf(message.data(), message.size(), format, values);
    return 1;  // nobody else is told
}
int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct Closed {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
    void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};
using File = std::unique_ptr<TIFF, Closed>;

File opened(Source& source) {
    constexpr tmsize_t kMostOfOneThing = tmsize_t(1) << 30;
    const std::unique_ptr<TIFFOpenOptions, Closed> options(TIFFOpenOptionsAlloc());
    if (!options) throw std::bad_alloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostOfOneThing);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &source);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &source);
    return File(TIFFClientOpenExt("TIFF", "rm", &source, on_read, on_write, on_seek, on_close, on_size,
                                  nullptr, nullptr, options.get()));
}

std::uint16_t tag(TIFF* tiff, std::uint32_t name) {
    std::uint16_t value = 0;
    TIFFGetFieldDefaulted(tiff, name, &value);
    return value;
}

// The parts of a file that are read, and the layout of its samples.
struct Layout {
    std::uint32_t width = 0, height = 0, block_width = 0, block_height = 0;
    std::uint64_t block_bytes = 0;
    int samples = 1, colours = 1;  // of a pixel in the file; the first of them that are colour
    int bits = 8;                  // of a sample
    bool floats = false, alpha = false, premultiplied = false, tiled = false, apart = false;

    int channels() const { return alpha ? 4 : colours; }
    int samples_of_block() const { return apart ? 1 : samples; }
};

std::string compression_of(TIFF* tiff) {
    switch (const int scheme = tag(tiff, TIFFTAG_COMPRESSION)) {
        case COMPRESSION_NONE:
            return "none";
        case COMPRESSION_LZW:
            return "lzw";
        case COMPRESSION_PACKBITS:
            return "rle";
        case COMPRESSION_ADOBE_DEFLATE:
        case COMPRESSION_DEFLATE:
            return "zip";
        case COMPRESSION_JPEG:
            return "jpeg";
        default:
            return "scheme " + std::to_string(scheme);
    }
}

// Why these samples are not read; nothing where they are.
std::string refusal_of_samples(TIFF* tiff, Layout& layout) {
    const int format = tag(tiff, TIFFTAG_SAMPLEFORMAT);
    layout.bits = tag(tiff, TIFFTAG_BITSPERSAMPLE);
    layout.floats = format == SAMPLEFORMAT_IEEEFP;
    const bool whole = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID;
    if ((whole && (layout.bits == 8 || layout.bits == 16)) ||
        (layout.floats && (layout.bits == 16 || layout.bits == 32)))
        return "";
    return "has samples of " + std::to_string(layout.bits) + " bit" +
           (layout.floats ? " float"
            : whole       ? ""
                          : ", neither whole numbers nor floats") +
           "; whole numbers of 8 or 16 bit and floats of 16 or 32 are read";
}

std::string refusal_of_colours(TIFF* tiff, Layout& layout) {
    if (tag(tiff, TIFFTAG_COMPRESSION) == COMPRESSION_JPEG)
        TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);  // YCbCr comes as RGB
    std::uint16_t kind = 0;
    if (!TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &kind)) kind = PHOTOMETRIC_MINISBLACK;
    const bool turned = kind == PHOTOMETRIC_YCBCR && tag(tiff, TIFFTAG_COMPRESSION) == COMPRESSION_JPEG;
    const bool rgb = kind == PHOTOMETRIC_RGB || turned;
    if (!rgb && kind != PHOTOMETRIC_MINISBLACK)
        return "holds no RGB and no grey with black as 0, but kind " + std::to_string(kind) +
               " (palette, inks, YCbCr, Lab, …)";
    layout.samples = tag(tiff, TIFFTAG_SAMPLESPERPIXEL), layout.colours = rgb ? 3 : 1;
    if (layout.samples < layout.colours) return "has fewer samples in a pixel than its colours are";
    std::uint16_t extra = 0, *kinds = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra, &kinds) && extra > 0 && kinds) {
        layout.premultiplied = kinds[0] == EXTRASAMPLE_ASSOCALPHA;
        layout.alpha =
            layout.samples > layout.colours && (layout.premultiplied || kinds[0] == EXTRASAMPLE_UNASSALPHA);
    }
    return "";
}

// Deflate packs at most 1032 to 1, LZW 2700 to 1; what packs more packs no picture so.
constexpr std::uint64_t kDensest = 4000;

std::string refusal_of_size(TIFF* tiff, Layout& layout, const InputFile& file, std::size_t max_pixels) {
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height);
    constexpr std::uint32_t kLongestSide = 1 << 20;
    const std::uint64_t pixels = std::uint64_t(layout.width) * layout.height;
    if (pixels == 0) return "has no pixels";
    if (layout.width > kLongestSide || layout.height > kLongestSide || pixels > max_pixels)
        return "has more pixels than allowed";
    const std::uint64_t bytes = pixels * unsigned(layout.samples) * unsigned(layout.bits / 8);
    if (bytes > kDensest * file.bytes())
        return "is cut off: its header promises more pixels than the file can hold";
    layout.tiled = TIFFIsTiled(tiff) != 0;
    layout.apart = tag(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    layout.block_width = layout.width;
    if (layout.tiled) {
        TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &layout.block_width);
        TIFFGetField(tiff, TIFFTAG_TILELENGTH, &layout.block_height);
    } else {
        TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &layout.block_height);
        layout.block_height = std::min(layout.block_height, layout.height);
    }
    layout.block_bytes = std::uint64_t(layout.block_width) * layout.block_height *
                         unsigned(layout.samples_of_block()) * unsigned(layout.bits / 8);
    const std::uint64_t of_library = layout.tiled ? TIFFTileSize64(tiff) : TIFFStripSize64(tiff);
    if (layout.block_bytes == 0 || layout.block_bytes != of_library || layout.block_width > kLongestSide ||
        layout.block_height > kLongestSide || layout.block_bytes > 4 * bytes + (1 << 24))
        return "has strips or tiles of an impossible size";
    return "";
}

// A block's bytes into the picture: `plane` is its first sample.
class Unpacker {
public:
    Unpacker(const Layout& layout, Raster& out) : layout_(layout), out_(out) {}

    void block(const std::vector<unsigned char>& bytes, std::uint32_t x0, std::uint32_t y0, int plane) {
        const std::size_t sample = std::size_t(layout_.bits) / 8;
        const std::uint32_t width = std::min(layout_.block_width, layout_.width - x0),
                            height = std::min(layout_.block_height, layout_.height - y0);
        const int count = layout_.samples_of_block();
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
                const std::size_t from = (std::size_t(y) * layout_.block_width + x) * std::size_t(count);
                const std::size_t to =
                    (std::size_t(y0 + y) * layout_.width + x0 + x) * std::size_t(out_.channels);
                for (int s = 0; s < count; ++s)
                    put(bytes.data() + (from + std::size_t(s)) * sample, to, plane + s);
            }
    }

private:
    void put(const unsigned char* from, std::size_t pixel, int sample) {
        if (sample < layout_.colours)
            store(from, pixel + std::size_t(sample));
        else if (layout_.alpha && sample == layout_.colours)
            store(from, pixel + 3);
        if (sample == 0 && layout_.alpha && layout_.colours == 1)  // grey with alpha becomes RGBA
            store(from, pixel + 1), store(from, pixel + 2);
    }
    void store(const unsigned char* from, std::size_t at) {
        std::uint16_t two = 0;
        if (layout_.bits == 8) two = *from;
        if (layout_.bits == 16) std::memcpy(&two, from, 2);
        if (!layout_.floats) out_.codes[at] = two;
        if (layout_.floats && layout_.bits == 16) {
            half value;
            value.setBits(two);
            out_.floats[at] = value;
        }
        if (layout_.bits == 32) std::memcpy(&out_.floats[at], from, 4);
    }

    const Layout& layout_;
    Raster& out_;
};

// Errors: what is wrong with the blocks; empty where all is well. Throws Cancelled.
std::string read_blocks(TIFF* tiff, const Layout& layout, const Workers& workers, Raster& out) {
    Unpacker unpacker(layout, out);
    std::vector<unsigned char> bytes(layout.block_bytes);
    const auto blocks = [](std::uint32_t size, std::uint32_t block) { return (size + block - 1) / block; };
    const std::uint32_t columns = blocks(layout.width, layout.block_width),
                        rows = blocks(layout.height, layout.block_height);
    std::uint32_t index = 0;
    for (int plane = 0; plane < (layout.apart ? layout.samples : 1); ++plane)
        for (std::uint32_t row = 0; row < rows; ++row)
            for (std::uint32_t column = 0; column < columns; ++column, ++index) {
                check_cancelled(workers);
                const std::uint32_t y = row * layout.block_height;
                // The last strip ends with the picture, the last tile does not.
                const std::uint64_t whole = layout.tiled
                                                ? layout.block_bytes
                                                : layout.block_bytes / layout.block_height *
                                                      std::min(layout.block_height, layout.height - y);
                const tmsize_t got = layout.tiled
                                         ? TIFFReadEncodedTile(tiff, index, bytes.data(), tmsize_t(whole))
                                         : TIFFReadEncodedStrip(tiff, index, bytes.data(), tmsize_t(whole));
                if (got < 0 || std::uint64_t(got) != whole)
                    return "rows from " + std::to_string(y) + " on cannot be unpacked";
                unpacker.block(bytes, column * layout.block_width, y, plane);
            }
    return "";
}

Raster raster_of(TIFF* tiff, const Layout& layout) {
    Raster out;
    out.width = int(layout.width), out.height = int(layout.height);
    out.channels = layout.channels();
    out.bits = layout.floats ? 32 : layout.bits;
    out.premultiplied = layout.premultiplied;
    out.compression = compression_of(tiff);
    const int unread = layout.samples - layout.colours - (layout.alpha ? 1 : 0);
    if (unread > 0) out.note = "TIFF: " + std::to_string(unread) + " more sample(s) of a pixel are not read";
    if (TIFFNumberOfDirectories(tiff) > 1) add_note(out.note, "TIFF: the first of several pictures is read");
    const int orientation = tag(tiff, TIFFTAG_ORIENTATION);  // EXIF took its numbers from here
    if (orientation > 1 && orientation <= 8) out.orientation = orientation;
    std::uint32_t profile_bytes = 0;
    void* profile = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_ICCPROFILE, &profile_bytes, &profile) && profile)
        add_note(out.note, note_of_profile({static_cast<const unsigned char*>(profile), profile_bytes}));
    out.more_bytes_per_pixel =
        std::size_t(layout.block_bytes / (std::uint64_t(layout.width) * layout.height) + 1);
    return out;
}

}  // namespace

Result<Raster> read_tiff(const InputFile& file, const ReadOptions& options, bool pixels) {
    Source source{file};
    const File tiff = opened(source);
    const auto damaged = [&](const std::string& what) {
        return unreadable(file.path(), source.message[0] ? source.message.data() : what);
    };
    if (!tiff) return damaged("no TIFF");
    Layout layout;
    std::string refused = refusal_of_samples(tiff.get(), layout);
    if (refused.empty()) refused = refusal_of_colours(tiff.get(), layout);
    if (refused.empty()) refused = refusal_of_size(tiff.get(), layout, file, options.max_pixels);
    if (!refused.empty()) return invalid_file(file.path(), refused);
    if (!TIFFIsCODECConfigured(tag(tiff.get(), TIFFTAG_COMPRESSION)))
        return invalid_file(file.path(),
                            "has a compression that cannot be read: " + compression_of(tiff.get()));
    Raster out = raster_of(tiff.get(), layout);
    if (!pixels) return out;
    if (layout.floats)
        out.floats.resize(out.count());
    else
        out.codes.resize(out.count());
    if (const std::string wrong = read_blocks(tiff.get(), layout, *options.workers, out); !wrong.empty())
        return damaged(wrong);
    return out;
}

bool starts_like_tiff(const InputFile& file) {
    std::array<unsigned char, 4> magic{};
    if (!file.read_at(0, magic.data(), 4)) return false;
    for (const char version : {char(42), char(43)}) {  // 43: BigTIFF
        const std::array<unsigned char, 4> little{'I', 'I', static_cast<unsigned char>(version), 0},
            big{'M', 'M', 0, static_cast<unsigned char>(version)};
        if (magic == little || magic == big) return true;
    }
    return false;
}

}  // namespace petzval

#endif
