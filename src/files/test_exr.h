// For tests: a folder that disappears, and a quick way to write any EXR.
#pragma once

#include "petzval/image.h"

#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "files/exr/file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTiledOutputPart.h>

namespace petzval::test {

// OpenEXR without its thread pool: thousands of tiny files would spend their time on waking threads.
class WithoutExrThreads {
public:
    WithoutExrThreads() { Imf::setGlobalThreadCount(0); }
    ~WithoutExrThreads() { Imf::setGlobalThreadCount(usable_threads()); }
    WithoutExrThreads(const WithoutExrThreads&) = delete;
    WithoutExrThreads& operator=(const WithoutExrThreads&) = delete;
};

inline std::string bytes_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
inline void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// Calls `look(bytes)` with `count` copies of a file of which a few bytes were changed at random; headers,
// where most harm can be done, are hit as often as pixels. Seeded: the same mutations on every run.
inline void mutate(const std::string& good, int count, const std::function<void(const std::string&)>& look) {
    std::mt19937 random(20);
    constexpr std::array<char, 8> nasty{0, 1, -1, 127, -128, 2, 64, 16};
    for (int i = 0; i < count; ++i) {
        std::string bad = good;
        const std::size_t range = random() % 2 ? bad.size() : std::min<std::size_t>(bad.size(), 600);
        for (unsigned n = random() % 4 + 1; n > 0; --n) {
            char& byte = bad[random() % range];
            byte = random() % 2 ? nasty[random() % nasty.size()] : char(random());
        }
        look(bad);
    }
}

// One channel; `value(x, y)` is asked with coordinates of the frame.
struct QuickChannel {
    std::string name;
    Imf::PixelType type = Imf::HALF;
    std::function<double(int, int)> value = [](int, int) { return 0.5; };
    int sampling = 1;
};

struct QuickPart {
    std::string name;
    std::string view;
    Rect data_window{0, 0, 8, 6};
    std::vector<QuickChannel> channels;
    int tile = 0;  // > 0: tiles of this size
    Imf::Compression compression = Imf::ZIP_COMPRESSION;
    std::function<void(Imf::Header&)> with = [](Imf::Header&) {};
};

inline Imf::Header quick_header(const Rect& display, const QuickPart& p) {
    const auto box = [](const Rect& r) {
        return Imath::Box2i(Imath::V2i(r.x0, r.y0), Imath::V2i(r.x1 - 1, r.y1 - 1));
    };
    Imf::Header header(box(display), box(p.data_window));
    header.setType(p.tile ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
    if (p.tile) header.setTileDescription(Imf::TileDescription(unsigned(p.tile), unsigned(p.tile)));
    if (!p.name.empty()) header.setName(p.name);
    if (!p.view.empty()) header.setView(p.view);
    header.compression() = p.compression;
    for (const QuickChannel& c : p.channels)
        header.channels().insert(c.name, Imf::Channel(c.type, c.sampling, c.sampling));
    p.with(header);
    return header;
}

// The samples of one channel, as the file stores them.
inline std::vector<char> quick_samples(const Rect& window, const QuickChannel& c) {
    const int width = window.width() / c.sampling, height = window.height() / c.sampling;
    const std::size_t size = c.type == Imf::HALF ? 2 : 4;
    std::vector<char> stored(std::size_t(width) * std::size_t(height) * size);
    char* to = stored.data();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, to += size) {
            const double v = c.value(window.x0 + x * c.sampling, window.y0 + y * c.sampling);
            if (c.type == Imf::HALF) *reinterpret_cast<Imath::half*>(to) = float(v);
            if (c.type == Imf::FLOAT) *reinterpret_cast<float*>(to) = float(v);
            if (c.type == Imf::UINT) *reinterpret_cast<std::uint32_t*>(to) = std::uint32_t(v);
        }
    return stored;
}

inline void write_quick_part(Imf::MultiPartOutputFile& file, int n, const QuickPart& p) {
    const Rect& w = p.data_window;
    std::vector<std::vector<char>> stored;
    Imf::FrameBuffer buffer;
    for (const QuickChannel& c : p.channels) {
        stored.push_back(quick_samples(w, c));
        const std::size_t size = c.type == Imf::HALF ? 2 : 4;
        const std::size_t row = size * std::size_t(w.width() / c.sampling);
        buffer.insert(c.name, Imf::Slice::Make(c.type, stored.back().data(), Imath::V2i(w.x0, w.y0),
                                               w.width(), w.height(), size, row, c.sampling, c.sampling));
    }
    if (!p.tile) {
        Imf::OutputPart out(file, n);
        out.setFrameBuffer(buffer);
        return out.writePixels(w.height());
    }
    Imf::TiledOutputPart out(file, n);
    out.setFrameBuffer(buffer);
    for (int y = 0; y < out.numYLevels(); ++y)
        for (int x = 0; x < out.numXLevels(); ++x)
            if (out.isValidLevel(x, y))
                out.writeTiles(0, out.numXTiles(x) - 1, 0, out.numYTiles(y) - 1, x, y);
}

inline void write_quick_exr(const std::string& path, const Rect& display,
                            const std::vector<QuickPart>& parts) {
    std::vector<Imf::Header> headers;
    for (const QuickPart& p : parts) headers.push_back(quick_header(display, p));
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), int(headers.size()));
    for (std::size_t n = 0; n < parts.size(); ++n) write_quick_part(file, int(n), parts[n]);
}

// R, G, B, A half and Z float, all different everywhere.
inline QuickPart quick_rgbaz(const Rect& window = {0, 0, 8, 6}) {
    QuickPart part;
    part.data_window = window;
    const auto ramp = [](double a, double b, double c) {
        return [=](int x, int y) { return a * x + b * y + c; };
    };
    part.channels = {{"R", Imf::HALF, ramp(0.25, 0.5, 1)},
                     {"G", Imf::HALF, ramp(-0.5, 0.125, 2)},
                     {"B", Imf::HALF, ramp(0.125, -0.25, 3)},
                     {"A", Imf::HALF, ramp(0, 0, 0.5)},
                     {"Z", Imf::FLOAT, ramp(0.1, 0.01, 2)}};
    return part;
}

}  // namespace petzval::test
