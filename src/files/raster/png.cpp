// libpng reports errors by longjmp, which skips C++ destructors: functions that call setjmp own nothing that
// needs one, everything lives with their callers.
#include "petzval/files.h"

#include "base/cancel.h"
#include "files/exr/file.h"
#include "files/output_file.h"
#include "files/raster/raster.h"
#include "files/raster/raster_tags.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <png.h>

namespace petzval {
namespace {

constexpr const char* kColourCodes = "cICP";  // older versions of libpng do not know this chunk

// State for libpng's callbacks.
struct PngReading {
    const InputFile* file = nullptr;
    const Workers* workers = nullptr;  // who may cancel; null: nobody
    bool cancelled = false;
    std::uint64_t position = 0;
    std::size_t max_pixels = 0;
    char message[256] = {};
    png_structp png = nullptr;
    png_infop info = nullptr;
    int width = 0, height = 0, channels = 0, bits = 0;
    png_bytepp rows = nullptr;

    ~PngReading() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct PngWriting {
    OutputFile* file = nullptr;  // one of the two
    std::string* bytes = nullptr;
    std::uint64_t position = 0;
    char message[256] = {};
    png_structp png = nullptr;
    png_infop info = nullptr;

    ~PngWriting() { png_destroy_write_struct(&png, &info); }
};

void copy_message(char (&to)[256], const char* from) { std::snprintf(to, sizeof to, "%s", from); }

template <typename State>
void on_error(png_structp png, png_const_charp message) {
    copy_message(static_cast<State*>(png_get_error_ptr(png))->message, message);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep to, png_size_t bytes) {
    auto* reading = static_cast<PngReading*>(png_get_io_ptr(png));
    if (!reading->file->read_at(reading->position, to, bytes)) png_error(png, "it ends too early");
    reading->position += bytes;
}

void on_row(png_structp png, png_uint_32, int) {
    auto* reading = static_cast<PngReading*>(png_get_io_ptr(png));
    if (!reading->workers) return;
    try {
        check_cancelled(*reading->workers);
    } catch (const Cancelled&) {
        reading->cancelled = true;
    }
    if (reading->cancelled) png_error(png, "cancelled");
}

void on_write(png_structp png, png_bytep from, png_size_t bytes) {
    auto* writing = static_cast<PngWriting*>(png_get_io_ptr(png));
    if (writing->bytes)
        writing->bytes->append(reinterpret_cast<const char*>(from), bytes);
    else if (!writing->file->write_at(writing->position, from, bytes))
        png_error(png, "it cannot be written");
    writing->position += bytes;
}

void on_flush(png_structp) {}

// Reads the header and asks for 8 or 16 bit grey, RGB or RGBA. False after an error.
bool read_png_header(PngReading& r) {
    if (setjmp(png_jmpbuf(r.png))) return false;
    constexpr png_uint_32 kLongestSide = 1 << 20;
    png_set_user_limits(r.png, kLongestSide, kLongestSide);
    png_set_read_fn(r.png, &r, on_read);
    png_set_read_status_fn(r.png, on_row);
    png_set_keep_unknown_chunks(r.png, PNG_HANDLE_CHUNK_ALWAYS,
                                reinterpret_cast<png_const_bytep>(kColourCodes), 1);
    png_read_info(r.png, r.info);
    png_uint_32 width = 0, height = 0;
    int depth = 0, type = 0;
    png_get_IHDR(r.png, r.info, &width, &height, &depth, &type, nullptr, nullptr, nullptr);
    if (std::uint64_t(width) * height > r.max_pixels) png_error(r.png, "it has more pixels than allowed");
    // Deflate packs at most 1032 to 1.
    if (std::uint64_t(width) * height * unsigned(depth) / 8 > r.file->bytes() * 1100)
        png_error(r.png, "its header promises more pixels than the file can hold; it is cut off");
    if (type == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(r.png);
    if (type == PNG_COLOR_TYPE_GRAY && depth < 8) png_set_expand_gray_1_2_4_to_8(r.png);
    if (png_get_valid(r.png, r.info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(r.png);
    const bool has_alpha = (type & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(r.png, r.info, PNG_INFO_tRNS);
    if (has_alpha && !(type & PNG_COLOR_MASK_COLOR)) png_set_gray_to_rgb(r.png);
    if (depth == 16) png_set_swap(r.png);  // files are big-endian
    png_set_interlace_handling(r.png);
    png_read_update_info(r.png, r.info);
    r.width = int(width), r.height = int(height);
    r.channels = png_get_channels(r.png, r.info);
    r.bits = png_get_bit_depth(r.png, r.info);
    return true;
}

// The reader uses no profile, no primaries and no transfer curve of the file; a sentence if the file has one
// that is not sRGB's.
std::string note_of_colours(const PngReading& r) {
    png_charp name = nullptr;
    png_bytep profile = nullptr;
    png_uint_32 bytes = 0;
    int compression = 0;
    if (png_get_iCCP(r.png, r.info, &name, &compression, &profile, &bytes)) {
        if (const std::string note = note_of_profile({profile, bytes}); !note.empty()) return note;
    }
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(r.png, r.info, &chunks);
    for (int i = 0; i < count; ++i) {
        constexpr png_byte kPrimaries = 1, kCurve = 13;
        if (std::string_view(reinterpret_cast<const char*>(chunks[i].name)) != kColourCodes) continue;
        if (chunks[i].size >= 2 && (chunks[i].data[0] != kPrimaries || chunks[i].data[1] != kCurve))
            return "its colour codes (cICP) are not used: colours are taken as Rec. 709's, with the curve of "
                   "read.transfer";
    }
    constexpr double kOfSrgb = 1 / 2.2, kRounding = 0.03;
    double gamma = kOfSrgb;
    if (!png_get_gAMA(r.png, r.info, &gamma) || std::abs(gamma - kOfSrgb) <= kRounding) return "";
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(),
                  "its gamma (gAMA) of %.4g is not used; read.transfer sets the curve", gamma);
    return text.data();
}

bool read_png_rows(PngReading& r) {
    if (setjmp(png_jmpbuf(r.png))) return false;
    png_read_image(r.png, r.rows);
    png_read_end(r.png, nullptr);
    return true;
}

bool write_png_rows(PngWriting& w, const PngPixels& p, png_bytepp rows, png_textp texts) {
    if (setjmp(png_jmpbuf(w.png))) return false;
    png_set_write_fn(w.png, &w, on_write, on_flush);
    const int type = p.channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : p.channels == 3 ? PNG_COLOR_TYPE_RGB
                                       : PNG_COLOR_TYPE_RGB_ALPHA;
    png_set_IHDR(w.png, w.info, png_uint_32(p.width), png_uint_32(p.height), p.bits, type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (p.pixel_aspect != 1) {  // pixels per unknown unit: narrow pixels are more to the width
        constexpr double kPerUnit = 10000;
        png_set_pHYs(w.png, w.info, png_uint_32(kPerUnit), png_uint_32(kPerUnit * p.pixel_aspect + 0.5),
                     PNG_RESOLUTION_UNKNOWN);
    }
    if (!p.texts.empty()) png_set_text(w.png, w.info, texts, int(p.texts.size()));
    png_write_info(w.png, w.info);
    if (p.bits == 16) png_set_swap(w.png);
    png_write_image(w.png, rows);
    png_write_end(w.png, w.info);
    return true;
}

// Rows of bytes in the machine's order, 1 or 2 per sample.
std::vector<png_byte> packed(const PngPixels& p) {
    if (p.bits == 8) return {p.samples.begin(), p.samples.end()};
    std::vector<png_byte> bytes(p.samples.size() * 2);
    std::copy_n(reinterpret_cast<const png_byte*>(p.samples.data()), bytes.size(), bytes.data());
    return bytes;
}

std::vector<png_bytep> row_pointers(std::vector<png_byte>& bytes, int height) {
    std::vector<png_bytep> rows(std::size_t(height), nullptr);
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = bytes.data() + y * (bytes.size() / rows.size());
    return rows;
}

Error png_error_of(const InputFile& file, const PngReading& r) {
    if (r.cancelled) throw Cancelled{};
    return unreadable(file.path(), r.message);
}

// Reads the header only when `pixels` is false. note: what of the file's colours is not used.
Result<PngPixels> read(const InputFile& file, std::size_t max_pixels, bool pixels,
                       const Workers* workers = nullptr, std::string* note = nullptr) {
    PngReading r;
    r.file = &file;
    r.workers = workers;
    r.max_pixels = max_pixels;
    r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, on_error<PngReading>, ignore_warning);
    r.info = r.png ? png_create_info_struct(r.png) : nullptr;
    if (!r.info)
        return Error{ErrorCode::OutOfMemory, printable(file.path(), 4096) + ": no memory for libpng"};
    if (!read_png_header(r)) return png_error_of(file, r);
    PngPixels out{r.width, r.height, r.channels, r.bits, {}};
    if (note) *note = note_of_colours(r);
    if (!pixels) return out;
    const std::size_t count = std::size_t(r.width) * std::size_t(r.height) * std::size_t(r.channels);
    std::vector<png_byte> bytes(count * std::size_t(r.bits / 8));
    std::vector<png_bytep> rows = row_pointers(bytes, r.height);
    r.rows = rows.data();
    if (!read_png_rows(r)) return png_error_of(file, r);
    if (r.bits == 8) {
        out.samples.assign(bytes.begin(), bytes.end());
    } else {
        out.samples.resize(count);
        std::copy(bytes.begin(), bytes.end(), reinterpret_cast<png_byte*>(out.samples.data()));
    }
    return out;
}

Status check_pixels(const PngPixels& p) {
    const bool shape = p.width > 0 && p.height > 0 &&
                       (p.channels == 1 || p.channels == 3 || p.channels == 4) &&
                       (p.bits == 8 || p.bits == 16);
    if (!shape || p.samples.size() != std::size_t(p.width) * std::size_t(p.height) * std::size_t(p.channels))
        return Error{ErrorCode::InvalidArgument,
                     "a PNG needs width x height x channels samples, 1, 3 or 4 channels and 8 or 16 bits"};
    return Done{};
}

// False after an error, which is in w.message unless there was no memory for libpng.
bool write_pixels(PngWriting& w, const PngPixels& p) {
    w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &w, on_error<PngWriting>, ignore_warning);
    w.info = w.png ? png_create_info_struct(w.png) : nullptr;
    if (!w.info) {
        copy_message(w.message, "no memory for libpng");
        return false;
    }
    std::vector<png_byte> bytes = packed(p);
    std::vector<png_bytep> rows = row_pointers(bytes, p.height);
    auto words = p.texts;  // png_text holds pointers to char that is not const
    std::vector<png_text> texts(words.size());
    for (std::size_t i = 0; i < texts.size(); ++i) {
        texts[i].compression = PNG_TEXT_COMPRESSION_NONE;
        texts[i].key = words[i].first.data();
        texts[i].text = words[i].second.data();
        texts[i].text_length = words[i].second.size();
    }
    return write_png_rows(w, p, rows.data(), texts.data());
}

}  // namespace

Result<Raster> read_png_raster(const InputFile& file, const ReadOptions& options, bool pixels) {
    Raster raster;
    Result<PngPixels> png = read(file, options.max_pixels, pixels, options.workers, &raster.note);
    if (!png) return png.error();
    raster.width = png->width, raster.height = png->height;
    raster.channels = png->channels, raster.bits = png->bits;
    raster.compression = "zip";
    raster.more_bytes_per_pixel = std::size_t(png->channels * png->bits / 8);  // its rows
    raster.codes = std::move(png->samples);
    return raster;
}

Result<std::string> text_of_png(const InputFile& file, const std::string& key) {
    PngReading r;
    r.file = &file;
    r.max_pixels = ReadOptions{}.max_pixels;
    r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, on_error<PngReading>, ignore_warning);
    r.info = r.png ? png_create_info_struct(r.png) : nullptr;
    if (!r.info || !read_png_header(r)) return png_error_of(file, r);
    png_textp texts = nullptr;
    const int count = png_get_text(r.png, r.info, &texts, nullptr);
    for (int i = 0; i < count; ++i)
        if (key == texts[i].key) return std::string(texts[i].text, texts[i].text_length);
    return std::string();
}

Result<PngPixels> read_png(const std::string& path, std::size_t max_pixels) {
    const auto file = InputFile::open(path);
    if (!file) return file.error();
    Result<PngPixels> pixels = PngPixels();
    const Status sound = guarded(**file, [&]() -> Status {
        pixels = read(**file, max_pixels, true);
        return pixels ? Status(Done{}) : pixels.error();
    });
    return sound ? std::move(pixels) : Result<PngPixels>(sound.error());
}

Status write_png(const std::string& path, const PngPixels& p, bool overwrite) {
    if (const Status fine = check_pixels(p); !fine) return fine.error();
    Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path, overwrite);
    if (!file) return file.error();
    PngWriting w;
    w.file = file->get();
    if (!write_pixels(w, p) && !(*file)->failed())
        return output_failed(path, "cannot be written: " + printable(w.message));
    return (*file)->commit();
}

Result<std::string> png_bytes(const PngPixels& p) {
    if (const Status fine = check_pixels(p); !fine) return fine.error();
    std::string bytes;
    PngWriting w;
    w.bytes = &bytes;
    if (!write_pixels(w, p)) return Error{ErrorCode::OutOfMemory, std::string("PNG: ") + w.message};
    return bytes;
}

}  // namespace petzval
