#include "files/raster/raster_tags.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

namespace petzval {
namespace {

// Numbers of a TIFF directory, in either order of bytes; 0 beyond the end.
struct Directory {
    TagBytes bytes;
    bool big_endian = false;

    std::uint32_t number(std::size_t at, std::size_t size) const {
        if (at > bytes.size() || size > bytes.size() - at) return 0;
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < size; ++i)
            value = value << 8 | bytes[at + (big_endian ? i : size - 1 - i)];
        return value;
    }
};

// Stored position of pixel (x, y) of the upright picture of width x height.
std::pair<int, int> stored_at(int x, int y, int width, int height, int orientation) {
    const int right = width - 1, bottom = height - 1;
    switch (orientation) {
        case 2:
            return {right - x, y};
        case 3:
            return {right - x, bottom - y};
        case 4:
            return {x, bottom - y};
        case 5:
            return {y, x};
        case 6:
            return {y, bottom - x};
        case 7:
            return {right - y, bottom - x};
        case 8:
            return {right - y, x};
        default:
            return {x, y};
    }
}

template <typename Sample>
void turn(std::vector<Sample>& samples, const Raster& stored, const Raster& turned) {
    if (samples.empty()) return;
    std::vector<Sample> to(samples.size());
    const auto step = std::size_t(stored.channels);
    for (int y = 0; y < turned.height; ++y)
        for (int x = 0; x < turned.width; ++x) {
            const auto [sx, sy] = stored_at(x, y, stored.width, stored.height, stored.orientation);
            const std::size_t from = std::size_t(sy) * std::size_t(stored.width) + std::size_t(sx);
            const std::size_t at = std::size_t(y) * std::size_t(turned.width) + std::size_t(x);
            std::copy_n(&samples[from * step], step, &to[at * step]);
        }
    samples.swap(to);
}

}  // namespace

int orientation_of_exif(TagBytes marker) {
    constexpr std::string_view kExifHead{"Exif\0\0", 6};
    if (marker.size() < kExifHead.size() ||
        std::memcmp(marker.data(), kExifHead.data(), kExifHead.size()) != 0)
        return 1;
    Directory tiff{marker.subspan(kExifHead.size())};
    tiff.big_endian = !tiff.bytes.empty() && tiff.bytes[0] == 'M';
    const std::size_t first = tiff.number(4, 4);
    for (std::size_t i = 0, entries = tiff.number(first, 2); i < entries; ++i) {
        const std::size_t entry = first + 2 + 12 * i;
        constexpr std::uint32_t kOrientation = 0x0112;
        if (tiff.number(entry, 2) != kOrientation) continue;
        const std::uint32_t value = tiff.number(entry + 8, 2);
        return value >= 1 && value <= 8 ? int(value) : 1;
    }
    return 1;
}

Raster upright(Raster raster) {
    if (raster.orientation == 1) return raster;
    Raster stored;
    stored.width = raster.width, stored.height = raster.height, stored.channels = raster.channels;
    stored.orientation = raster.orientation;
    if (raster.orientation >= 5) std::swap(raster.width, raster.height);
    turn(raster.codes, stored, raster);
    turn(raster.floats, stored, raster);
    raster.orientation = 1;
    add_note(raster.note, "turned upright by its orientation tag");
    return raster;
}

std::string note_of_profile(TagBytes icc) {
    if (icc.empty()) return "";
    // The name is text of one or of two bytes a letter.
    for (const std::string_view name : {std::string_view("sRGB"), std::string_view("s\0R\0G\0B", 7)})
        if (std::search(icc.begin(), icc.end(), name.begin(), name.end()) != icc.end()) return "";
    return "its colour profile is not used: colours are taken as Rec. 709's";
}

void add_note(std::string& notes, const std::string& note) {
    if (!note.empty()) notes += (notes.empty() ? "" : "; ") + note;
}

}  // namespace petzval
