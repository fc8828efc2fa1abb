// libjpeg reports errors by leaving through longjmp, which skips C++ destructors: functions that call setjmp
// own nothing that needs one, everything lives with their callers.
#ifdef PETZVAL_JPEG

#include "base/cancel.h"
#include "files/raster/raster_tags.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <string_view>

// It needs <cstdio> before it.
#include <jerror.h>
#include <jpeglib.h>

namespace petzval {
namespace {

constexpr int kExif = JPEG_APP0 + 1, kProfile = JPEG_APP0 + 2;

struct Reading {
    const InputFile* file = nullptr;
    const Workers* workers = nullptr;
    std::uint64_t position = 0;
    std::size_t max_pixels = 0;
    bool cancelled = false;
    std::array<char, JMSG_LENGTH_MAX> message{};
    std::array<JOCTET, 1 << 16> buffer{};
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_source_mgr source{};
    jpeg_progress_mgr progress{};
    std::jmp_buf back{};

    Reading() = default;
    Reading(const Reading&) = delete;
    ~Reading() { jpeg_destroy_decompress(&jpeg); }
};

Reading& of(j_common_ptr jpeg) { return *static_cast<Reading*>(jpeg->client_data); }
Reading& of(j_decompress_ptr jpeg) { return *static_cast<Reading*>(jpeg->client_data); }

[[noreturn]] void leave(Reading& r, const char* message) {
    std::snprintf(r.message.data(), r.message.size(), "%s", message);
    std::longjmp(r.back, 1);
}

[[noreturn]] void on_error(j_common_ptr jpeg) {
    Reading& r = of(jpeg);
    r.errors.format_message(jpeg, r.message.data());
    std::longjmp(r.back, 1);
}

// libjpeg repairs some damage and continues; that counts as damage, unless no pixel is affected.
void on_message(j_common_ptr jpeg, int level) {
    const int code = jpeg->err->msg_code;
    const bool harmless = code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM || code == JWRN_JFIF_MAJOR;
    if (level < 0 && !harmless) on_error(jpeg);
}

void on_start(j_decompress_ptr) {}
void on_end(j_decompress_ptr) {}

boolean on_fill(j_decompress_ptr jpeg) {
    Reading& r = of(jpeg);
    const std::size_t bytes = std::min<std::uint64_t>(r.buffer.size(), r.file->bytes() - r.position);
    if (bytes == 0 || !r.file->read_at(r.position, r.buffer.data(), bytes)) leave(r, "it ends too early");
    r.position += bytes;
    r.source.next_input_byte = r.buffer.data(), r.source.bytes_in_buffer = bytes;
    return TRUE;
}

void on_skip(j_decompress_ptr jpeg, long bytes) {
    Reading& r = of(jpeg);
    if (bytes <= 0) return;
    if (std::size_t(bytes) <= r.source.bytes_in_buffer) {
        r.source.next_input_byte += bytes, r.source.bytes_in_buffer -= std::size_t(bytes);
        return;
    }
    r.position = std::min(r.file->bytes(), r.position + std::uint64_t(bytes) - r.source.bytes_in_buffer);
    r.source.bytes_in_buffer = 0;
}

// Scans of a progressive file are passes over all of it, and a small file may hold very many.
void on_progress(j_common_ptr jpeg) {
    constexpr int kMostScans = 200;
    Reading& r = of(jpeg);
    if (r.jpeg.input_scan_number > kMostScans) leave(r, "it has more than 200 scans");
    try {
        check_cancelled(*r.workers);
    } catch (const Cancelled&) {
        r.cancelled = true;
    }
    if (r.cancelled) leave(r, "cancelled");
}

// False after an error.
bool read_header(Reading& r) {
    if (setjmp(r.back)) return false;
    jpeg_create_decompress(&r.jpeg);
    r.jpeg.client_data = &r;  // which creating has cleared
    r.jpeg.src = &r.source, r.jpeg.progress = &r.progress;
    for (const int marker : {kExif, kProfile}) jpeg_save_markers(&r.jpeg, marker, 0xffff);
    jpeg_read_header(&r.jpeg, TRUE);
    // A block of 8 x 8 pixels takes a bit at least.
    constexpr std::uint64_t kMostPixelsPerByte = 512;
    const std::uint64_t pixels = std::uint64_t(r.jpeg.image_width) * r.jpeg.image_height;
    if (pixels > r.max_pixels) leave(r, "it has more pixels than allowed");
    if (pixels > kMostPixelsPerByte * r.file->bytes())
        leave(r, "its header promises more pixels than the file can hold; it is cut off");
    if (r.jpeg.num_components != 1 && r.jpeg.num_components != 3)
        leave(r, "it is CMYK; RGB or grey is needed");
    r.jpeg.out_color_space = r.jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    return true;
}

void decode_rows(Reading& r, JSAMPLE* row, std::uint16_t* to) {
    jpeg_start_decompress(&r.jpeg);
    const std::size_t samples = std::size_t(r.jpeg.output_width) * unsigned(r.jpeg.output_components);
    while (r.jpeg.output_scanline < r.jpeg.output_height) {
        jpeg_read_scanlines(&r.jpeg, &row, 1);
        for (std::size_t i = 0; i < samples; ++i) *to++ = row[i];
    }
    jpeg_finish_decompress(&r.jpeg);
}

bool read_rows(Reading& r, JSAMPLE* row, std::uint16_t* to) {
    if (setjmp(r.back)) return false;
    decode_rows(r, row, to);
    return true;
}

void read_markers(const Reading& r, Raster& out) {
    for (const jpeg_marker_struct* m = r.jpeg.marker_list; m; m = m->next) {
        const TagBytes bytes(m->data, m->data_length);
        if (m->marker == kExif && out.orientation == 1) out.orientation = orientation_of_exif(bytes);
        constexpr std::string_view kName{"ICC_PROFILE\0", 12};
        if (m->marker != kProfile || bytes.size() < 14 || bytes[12] != 1) continue;  // the first piece of one
        if (std::equal(kName.begin(), kName.end(), bytes.begin())) add_note(out.note, note_of_profile(bytes));
    }
}

Error error_of(const InputFile& file, const Reading& r) {
    if (r.cancelled) throw Cancelled{};
    return unreadable(file.path(), r.message.data());
}

}  // namespace

Result<Raster> read_jpeg(const InputFile& file, const ReadOptions& options, bool pixels) {
    const auto reading = std::make_unique<Reading>();
    Reading& r = *reading;
    r.file = &file, r.workers = options.workers, r.max_pixels = options.max_pixels;
    r.jpeg.err = jpeg_std_error(&r.errors);
    r.jpeg.client_data = &r;
    r.errors.error_exit = on_error, r.errors.emit_message = on_message;
    r.source.init_source = on_start, r.source.term_source = on_end;
    r.source.fill_input_buffer = on_fill, r.source.skip_input_data = on_skip;
    r.source.resync_to_restart = jpeg_resync_to_restart;
    r.progress.progress_monitor = on_progress;
    if (!read_header(r)) return error_of(file, r);
    Raster out;
    out.width = int(r.jpeg.image_width), out.height = int(r.jpeg.image_height);
    out.channels = r.jpeg.num_components;
    out.compression = "jpeg";
    read_markers(r, out);
    // Scans one after the other: all coefficients are kept.
    if (jpeg_has_multiple_scans(&r.jpeg)) out.more_bytes_per_pixel = 2 * std::size_t(out.channels);
    if (!pixels) return out;
    out.codes.resize(out.count());
    std::vector<JSAMPLE> row(std::size_t(out.width) * std::size_t(out.channels));
    if (!read_rows(r, row.data(), out.codes.data())) return error_of(file, r);
    return out;
}

bool starts_like_jpeg(const InputFile& file) {
    std::array<unsigned char, 3> magic{};
    return file.read_at(0, magic.data(), 3) && magic == std::array<unsigned char, 3>{0xff, 0xd8, 0xff};
}

}  // namespace petzval

#endif
