// Pictures that are rows of pixels and nothing else, no layers, no windows: PNG, JPEG, TIFF.
#pragma once

#include "petzval/files.h"

#include "files/input_file.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace petzval {

// Samples as stored, interleaved, row by row.
struct Raster {
    int width = 0, height = 0;
    int channels = 0;  // 1, 3 or 4: grey, RGB, RGBA
    int bits = 8;      // 8 or 16: whole numbers; 32: floats
    bool premultiplied = false;
    int orientation = 1;  // where its first row and column are, as EXIF counts; read_raster() turns it
    std::string compression, note;         // note: what of the file is not read; may be empty
    std::size_t more_bytes_per_pixel = 0;  // while it is read
    std::vector<std::uint16_t> codes;      // one of the two; both empty where the header alone was read
    std::vector<float> floats;

    bool is_float() const { return bits == 32; }
    Rect rect() const { return {0, 0, width, height}; }
    std::size_t count() const { return std::size_t(width) * std::size_t(height) * std::size_t(channels); }
};

struct RasterFormat {
    const char *name, *type;  // "PNG", in sentences; "png", as inspect lists it
    bool (*starts_like)(const InputFile&);
    // Reads the file; only the header if `pixels` is false. Uses the read limit and the cancelling of the
    // options. Errors: InvalidFile for damaged, oversized or unsupported files. Throws Cancelled.
    Result<Raster> (*read)(const InputFile&, const ReadOptions&, bool pixels);
};

// The format by content; null if none matches.
const RasterFormat* raster_format_of(const InputFile& file);
// "PNG, JPEG, TIFF": those that were built in.
std::string raster_formats();

// With pixels, against options.max_memory_bytes first. `of_pixel`: bytes that a caller makes of each.
// Requires: options.workers.
Result<Raster> read_raster(const InputFile& file, const RasterFormat& format, const ReadOptions& options,
                           std::size_t of_pixel);

// Whole numbers are display-referred and decoded through options.transfer; floats are light. Premultiplied.
// `pixels` false: size only. Requires: options.workers.
Result<Frame> read_raster_frame(const std::shared_ptr<const InputFile>& file, const RasterFormat& format,
                                const ReadOptions& options, bool pixels);

// The text under that keyword before the pixels; empty where there is none.
Result<std::string> text_of_png(const InputFile& file, const std::string& key);
Result<Raster> read_png_raster(const InputFile& file, const ReadOptions& options, bool pixels);
bool starts_like_jpeg(const InputFile& file);
Result<Raster> read_jpeg(const InputFile& file, const ReadOptions& options, bool pixels);
bool starts_like_tiff(const InputFile& file);
Result<Raster> read_tiff(const InputFile& file, const ReadOptions& options, bool pixels);

}  // namespace petzval
