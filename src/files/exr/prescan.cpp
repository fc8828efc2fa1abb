// File layout: "OpenEXR File Layout", openexr.com: magic, version and flags, then per part a list of
// attributes (name 0, type 0, size, value) closed by a 0; several parts are closed by one more 0.
#include "files/exr/prescan.h"

#include "files/wording.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace petzval {
namespace {

constexpr std::uint32_t kMultiPart = 0x1000;
constexpr std::size_t kLongestName = 255;
constexpr int kMostParts = 10000;

struct Damaged {
    std::string what;
};

// Little-endian reader of the header; throws Damaged at its end.
class Cursor {
public:
    explicit Cursor(const InputFile& file) : file_(file) {}

    std::uint8_t byte() {
        if (position_ < start_ || position_ >= start_ + buffer_.size()) fill();
        return std::uint8_t(buffer_[std::size_t(position_++ - start_)]);
    }
    std::int32_t int32() {
        std::uint32_t v = 0;
        for (int i = 0; i < 4; ++i) v |= std::uint32_t(byte()) << (8 * i);
        return std::int32_t(v);
    }
    std::string name() {
        std::string out;
        while (const std::uint8_t c = byte()) {
            out += char(c);
            if (out.size() > kLongestName) throw Damaged{"its header holds a name longer than 255 letters"};
        }
        return out;
    }
    std::uint64_t position() const { return position_; }
    std::uint64_t left() const { return file_.bytes() - position_; }
    void seek(std::uint64_t position) { position_ = position; }

private:
    void fill() {
        if (position_ >= file_.bytes()) throw Damaged{"its header is cut off"};
        start_ = position_;
        buffer_.resize(std::size_t(std::min<std::uint64_t>(4096, file_.bytes() - position_)));
        if (!file_.read_at(start_, buffer_.data(), buffer_.size())) throw Damaged{"it cannot be read"};
    }

    const InputFile& file_;
    std::uint64_t position_ = 0, start_ = 0;
    std::vector<char> buffer_;
};

struct HeaderFacts {
    double data_pixels = -1;
    double bytes_per_pixel = 0;
    int compression = 0;
    std::int64_t chunks = 0;
    bool deep = false;
};

double pixels_of_window(Cursor& in, const char* what, std::size_t max_pixels) {
    const std::int64_t x0 = in.int32(), y0 = in.int32(), x1 = in.int32(), y1 = in.int32();
    if (x1 < x0 || y1 < y0) throw Damaged{std::string("its ") + what + " window is empty"};
    const double width = double(x1 - x0 + 1), height = double(y1 - y0 + 1);
    if (width * height > double(max_pixels))
        throw Damaged{std::string("its ") + what + " window is " + number(width) + " x " + number(height) +
                      " pixels, more than the " + std::to_string(max_pixels) + " allowed"};
    constexpr std::int64_t kFar = 1 << 29;
    if (std::max({x0, y0, x1, y1}) > kFar || std::min({x0, y0, x1, y1}) < -kFar)
        throw Damaged{std::string("its ") + what + " window is too far from pixel 0,0"};
    return width * height;
}

double bytes_of_channels(Cursor& in, std::uint64_t end) {
    double bytes = 0;
    while (in.position() < end) {
        if (in.name().empty()) break;
        const int type = in.int32();
        in.int32();  // pLinear and three reserved bytes
        const std::int32_t x_sampling = in.int32(), y_sampling = in.int32();
        if (x_sampling < 1 || y_sampling < 1) throw Damaged{"a channel has an impossible sampling rate"};
        bytes += (type == 1 ? 2.0 : 4.0) / double(x_sampling) / double(y_sampling);
    }
    return bytes;
}

// The most pixel bytes that one byte of the file can stand for. Deflate reaches 1032, PIZ's run lengths about
// 400, DWA deflates what is already a 64th.
double densest(int compression) {
    constexpr std::array<double, 10> ratios{1, 70, 2100, 2100, 2100, 2100, 16, 16, 140000, 140000};
    return compression >= 0 && compression < int(ratios.size()) ? ratios[std::size_t(compression)] : 140000;
}

void look_at_attribute(Cursor& in, const std::string& name, const std::string& type, std::uint64_t end,
                       std::size_t max_pixels, HeaderFacts& facts) {
    const std::uint64_t size = end - in.position();
    if (name == "dataWindow" && size == 16) facts.data_pixels = pixels_of_window(in, "data", max_pixels);
    if (name == "displayWindow" && size == 16) pixels_of_window(in, "display", max_pixels);
    if (name == "channels" && type == "chlist") facts.bytes_per_pixel = bytes_of_channels(in, end);
    if (name == "compression" && size == 1) facts.compression = in.byte();
    if (name == "chunkCount" && size == 4) facts.chunks = in.int32();
    if (name == "type" && size == 12) facts.deep = in.byte() == 'd';  // "deepscanline"
    if (name == "type" && size == 8) facts.deep = in.byte() == 'd';   // "deeptile"
}

// False where the list of headers ends. `chunks` grows by those the part declares.
bool look_at_header(Cursor& in, std::uint64_t file_bytes, std::size_t max_pixels, std::int64_t& chunks) {
    HeaderFacts facts;
    std::string name = in.name();
    if (name.empty()) return false;
    for (; !name.empty(); name = in.name()) {
        const std::string type = in.name();
        const std::int32_t size = in.int32();
        if (size < 0 || std::uint64_t(size) > in.left())
            throw Damaged{"its header attribute '" + printable(name) + "' is longer than the file"};
        const std::uint64_t end = in.position() + std::uint64_t(size);
        look_at_attribute(in, name, type, end, max_pixels, facts);
        in.seek(end);
    }
    // A deep part stores at least the number of samples of every pixel.
    const double promised = facts.data_pixels * (facts.deep ? 4 : facts.bytes_per_pixel);
    if (promised > double(file_bytes) * densest(facts.compression))
        throw Damaged{"its header promises " + byte_count(std::uint64_t(promised)) +
                      " of pixels, which cannot be in a file of " + byte_count(file_bytes) +
                      "; it is cut off"};
    if (facts.chunks < 0) throw Damaged{"a part has an impossible number of chunks"};
    chunks += facts.chunks;
    return true;
}

// The parts that pass through untouched are read only when the result is written; that they were cut off is
// known here already.
void look_at_chunk_tables(Cursor& in, std::uint64_t file_bytes, std::int64_t chunks) {
    if (std::uint64_t(chunks) > in.left() / 8) throw Damaged{"its table of chunks is cut off"};
    for (; chunks > 0; --chunks) {
        const std::uint64_t low = std::uint32_t(in.int32()), high = std::uint32_t(in.int32());
        if ((low | high << 32) >= file_bytes) throw Damaged{"pixels are missing at its end; it is cut off"};
    }
}

}  // namespace

std::optional<std::string> refuse_exr(const InputFile& file, std::size_t max_pixels,
                                      std::uint64_t& headers_end) {
    try {
        Cursor in(file);
        in.int32();  // magic number
        const std::uint32_t version = std::uint32_t(in.int32());
        if ((version & 0xff) != 2)
            return "is of OpenEXR version " + std::to_string(version & 0xff) + ", not 2";
        std::int64_t chunks = 0;
        if (!(version & kMultiPart)) {
            if (!look_at_header(in, file.bytes(), max_pixels, chunks)) return "has no header";
            headers_end = in.position();
            return std::nullopt;
        }
        int parts = 0;
        while (look_at_header(in, file.bytes(), max_pixels, chunks))
            if (++parts > kMostParts) return "has more than " + std::to_string(kMostParts) + " parts";
        headers_end = in.position();
        look_at_chunk_tables(in, file.bytes(), chunks);
        return std::nullopt;
    } catch (const Damaged& damaged) {
        return damaged.what;
    }
}

bool starts_like_exr(const InputFile& file) {
    std::array<unsigned char, 4> magic{};
    return file.read_at(0, magic.data(), 4) && magic == std::array<unsigned char, 4>{0x76, 0x2f, 0x31, 0x01};
}

bool starts_like_png(const InputFile& file) {
    std::array<unsigned char, 8> magic{};
    return file.read_at(0, magic.data(), 8) &&
           magic == std::array<unsigned char, 8>{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
}

}  // namespace petzval
