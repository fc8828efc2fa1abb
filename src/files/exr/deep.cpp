#include "files/exr/deep.h"

#include "base/cancel.h"
#include "base/parallel.h"
#include "files/exr/chunks.h"
#include "files/exr/pixels.h"
#include "files/memory_limit.h"
#include "files/wording.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>

namespace petzval {
namespace {

constexpr int kBandRows = 64;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Scanline and tiled deep parts behind one face: whole rows y0 … y1 - 1 counted from the data window's top,
// which for tiles must be rows of tiles.
class DeepPart {
public:
    DeepPart(const ExrFile& exr, std::size_t part) : window_(exr.layout.parts[part].data_window) {
        if (exr.layout.parts[part].tiled)
            tiles_.emplace(*exr.parts, int(part));
        else
            lines_.emplace(*exr.parts, int(part));
    }
    int band_rows() const {
        if (!tiles_) return kBandRows;
        const int tile = int(std::min<unsigned>(tiles_->tileYSize(), unsigned(window_.height())));
        return std::max(1, kBandRows / tile) * tile;
    }
    void set(const Imf::DeepFrameBuffer& buffer) {
        tiles_ ? tiles_->setFrameBuffer(buffer) : lines_->setFrameBuffer(buffer);
    }
    // Chunks of the first level, one after the other: rows, or tiles.
    int chunks() const { return tiles_ ? tiles_->numXTiles() * tiles_->numYTiles() : window_.height(); }
    // The chunk as it stands in the file, of that many bytes. Throws OpenEXR's exceptions.
    DeepChunk chunk(int i, std::uint64_t file_bytes) {
        DeepChunk chunk;
        chunk.pixels = Rect{window_.x0, window_.y0 + i, window_.x1, window_.y0 + i + 1};
        chunk.whole_pixels = std::uint64_t(window_.width());
        if (tiles_) {
            const int x = window_.x0 + i % tiles_->numXTiles() * int(tiles_->tileXSize()),
                      y = window_.y0 + i / tiles_->numXTiles() * int(tiles_->tileYSize());
            chunk.whole_pixels = std::uint64_t(tiles_->tileXSize()) * tiles_->tileYSize();
            chunk.pixels =
                Rect{x, y, x + int(tiles_->tileXSize()), y + int(tiles_->tileYSize())}.intersected(window_);
        }
        std::uint64_t size = 0;
        raw(i, nullptr, size);
        if (size > file_bytes) throw Iex::InputExc("a chunk is larger than the file");
        std::vector<unsigned char> bytes(size);
        raw(i, reinterpret_cast<char*>(bytes.data()), size);
        // Its place, as one number or four of a tile; then how large counts and samples are, and were.
        const std::size_t sizes = tiles_ ? 16 : 4, data = sizes + 24;
        std::uint64_t counts = 0;
        std::memcpy(&counts, bytes.data() + sizes, sizeof counts);
        const auto split = bytes.begin() + std::ptrdiff_t(data + std::min(counts, size - data));
        chunk.counts.assign(bytes.begin() + std::ptrdiff_t(data), split);
        chunk.samples.assign(split, bytes.end());
        return chunk;
    }
    void read_counts(int y0, int y1) {
        if (tiles_)
            tiles_->readPixelSampleCounts(0, tiles_->numXTiles() - 1, tile_row(y0), tile_row(y1 - 1));
        else
            lines_->readPixelSampleCounts(window_.y0 + y0, window_.y0 + y1 - 1);
    }
    void read_samples(int y0, int y1) {
        if (tiles_)
            tiles_->readTiles(0, tiles_->numXTiles() - 1, tile_row(y0), tile_row(y1 - 1));
        else
            lines_->readPixels(window_.y0 + y0, window_.y0 + y1 - 1);
    }

private:
    void raw(int i, char* to, std::uint64_t& size) {
        if (!tiles_) return lines_->rawPixelData(window_.y0 + i, to, size);
        int x = i % tiles_->numXTiles(), y = i / tiles_->numXTiles(), level_x = 0, level_y = 0;
        tiles_->rawTileData(x, y, level_x, level_y, to, size);
    }
    int tile_row(int y) const { return int(unsigned(y) / tiles_->tileYSize()); }

    Rect window_;
    std::optional<Imf::DeepScanLineInputPart> lines_;
    std::optional<Imf::DeepTiledInputPart> tiles_;
};

// OpenEXR addresses pixels by their place in the frame: the pointer it wants for an array that starts at
// (x0, y0).
template <typename T>
char* frame_base(T* first, int x0, int y0, int width) {
    return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(first) -
                                   std::intptr_t(sizeof(T)) * (x0 + std::intptr_t(y0) * width));
}

class DeepReader {
public:
    DeepReader(const ExrFile& exr, const ColourChoice& colour, const DepthChoice& depth)
        : exr_(exr),
          part_number_(colour.part),
          part_(exr, colour.part),
          description_(exr.layout.parts[colour.part]),
          window_(description_.data_window),
          width_(std::size_t(window_.width())) {
        const std::string& red = colour.is_luminance() ? colour.luminance : colour.red;
        add(red, [](DeepSample& s) { return &s.colour.r; });
        add(colour.green, [](DeepSample& s) { return &s.colour.g; });
        add(colour.blue, [](DeepSample& s) { return &s.colour.b; });
        add(colour.alpha, [](DeepSample& s) { return &s.colour.a; });
        add(depth.channel, [](DeepSample& s) { return &s.depth; });
        add(depth.back, [](DeepSample& s) { return &s.depth_back; });
    }

    Result<DeepPicture> read(const ReadOptions& options) {
        const std::string& path = exr_.file->path();
        counts_.assign(width_ * std::size_t(window_.height()), 0);
        part_.set(counts_only(counts_.data(), window_.y0));
        part_.read_counts(0, window_.height());
        first_.resize(counts_.size() + 1);
        for (std::size_t i = 0; i < counts_.size(); ++i) first_[i + 1] = first_[i] + counts_[i];
        if (Status sound = check_chunks(); !sound) return sound.error();
        if (const std::string reason = absurd(first_.back(), 2 * options.max_pixels); !reason.empty())
            return invalid_file(path, reason);
        const std::size_t of_pixel = sizeof(Rgba) + sizeof(float) + sizeof(unsigned) + sizeof(std::size_t);
        if (Status s =
                fits_memory(*exr_.file, window_, of_pixel, options, first_.back() * sizeof(DeepSample));
            !s)
            return s.error();
        samples_.assign(first_.back(), {{0, 0, 0, 1}, 0, 0});
        for (int y = 0; y < window_.height(); y += part_.band_rows())
            if (!read_band(y, std::min(y + part_.band_rows(), window_.height())))
                return invalid_file(path, "changed while it was read");
        return DeepPicture(window_.width(), window_.height(), std::move(first_), std::move(samples_));
    }

private:
    struct Target {
        std::string channel;
        float* (*of)(DeepSample&);
    };

    // Checks each chunk before its samples are read: OpenEXR takes missing data from its buffers.
    Status check_chunks() {
        for (int i = 0; i < part_.chunks(); ++i) {
            check_cancelled(*exr_.workers);
            const DeepChunk chunk = part_.chunk(i, exr_.file->bytes());
            std::uint64_t samples = 0;
            const Rect r = chunk.pixels.moved(-window_.x0, -window_.y0);
            for (int y = r.y0; y < r.y1; ++y)
                for (int x = r.x0; x < r.x1; ++x)
                    samples += counts_[std::size_t(y) * width_ + std::size_t(x)];
            if (Status sound = check_deep_chunk(exr_, part_number_, chunk, samples); !sound) return sound;
        }
        return Done{};
    }

    void add(const std::string& channel, float* (*of)(DeepSample&)) {
        if (!channel.empty()) targets_.push_back({channel, of});
    }

    Imf::DeepFrameBuffer counts_only(unsigned* counts, int y0) const {
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT,
                                                 frame_base(counts, window_.x0, y0, window_.width()),
                                                 sizeof(unsigned), sizeof(unsigned) * width_));
        return buffer;
    }

    // A few bytes can stand for many samples, but real ones do not repeat for ever.
    std::string absurd(std::size_t count, std::size_t most) const {
        double bytes = 0;
        for (const Channel& c : description_.channels) bytes += c.type == ChannelType::Half ? 2 : 4;
        constexpr std::size_t kAlwaysAllowed = std::size_t(1) << 24;
        constexpr double kDensest = 200;
        if (count > most)
            return "holds " + std::to_string(count) + " deep samples, more than " + std::to_string(most);
        if (count > kAlwaysAllowed && double(count) * bytes > kDensest * double(exr_.file->bytes()))
            return "promises " + std::to_string(count) + " deep samples, more than a file of " +
                   byte_count(exr_.file->bytes()) + " holds";
        return "";
    }

    bool read_band(int y0, int y1) {
        const std::size_t first_pixel = std::size_t(y0) * width_, pixels = std::size_t(y1 - y0) * width_;
        std::vector<unsigned> counts(pixels);
        Imf::DeepFrameBuffer buffer = counts_only(counts.data(), window_.y0 + y0);
        std::vector<std::vector<char*>> pointers(targets_.size());
        for (std::size_t t = 0; t < targets_.size(); ++t) {
            pointers[t].resize(pixels);
            for (std::size_t i = 0; i < pixels; ++i) {
                const std::size_t sample = first_[first_pixel + i];
                if (sample < first_[first_pixel + i + 1])
                    pointers[t][i] = reinterpret_cast<char*>(targets_[t].of(samples_[sample]));
            }
            buffer.insert(
                targets_[t].channel,
                Imf::DeepSlice(Imf::FLOAT,
                               frame_base(pointers[t].data(), window_.x0, window_.y0 + y0, window_.width()),
                               sizeof(char*), sizeof(char*) * width_, sizeof(DeepSample)));
        }
        part_.set(buffer);
        part_.read_counts(y0, y1);
        // The samples have places for the first counts only.
        if (!std::equal(counts.begin(), counts.end(), counts_.begin() + std::ptrdiff_t(first_pixel)))
            return false;
        part_.read_samples(y0, y1);
        return true;
    }

    const ExrFile& exr_;
    std::size_t part_number_;
    DeepPart part_;
    const Part& description_;
    Rect window_;
    std::size_t width_;
    std::vector<Target> targets_;
    std::vector<unsigned> counts_;
    std::vector<std::size_t> first_;
    std::vector<DeepSample> samples_;
};

// Sound values and nearest first. Distance counts without its sign: some renderers look down the negative
// axis.
std::size_t tidy(std::span<DeepSample> pixel, bool has_back, bool grey) {
    std::size_t replaced = 0;
    for (DeepSample& s : pixel) {
        for (float* v : {&s.colour.r, &s.colour.g, &s.colour.b, &s.colour.a}) replaced += made_finite(*v);
        if (grey) s.colour.g = s.colour.b = s.colour.r;
        if (std::isnan(s.depth)) s.depth = kInfinity;
        if (!has_back || std::isnan(s.depth_back)) s.depth_back = s.depth;
    }
    const auto nearer = [](const DeepSample& p, const DeepSample& q) {
        return std::abs(p.depth) < std::abs(q.depth);
    };
    if (!std::is_sorted(pixel.begin(), pixel.end(), nearer))
        std::stable_sort(pixel.begin(), pixel.end(), nearer);
    return replaced;
}

}  // namespace

Result<DeepPicture> read_deep(const ExrFile& exr, const ColourChoice& colour, const DepthChoice& depth,
                              const ReadOptions& options, std::size_t& non_finite) {
    DeepPicture deep;
    if (Status s = exr.check_complete(colour.part); !s) return s.error();
    const Status read = guarded(*exr.file, [&]() -> Status {
        Result<DeepPicture> all = DeepReader(exr, colour, depth).read(options);
        if (!all) return all.error();
        deep = std::move(*all);
        return Done{};
    });
    if (!read) return read.error();
    std::vector<std::size_t> replaced(std::size_t(deep.height()));
    parallel_for(deep.height(), *exr.workers, [&](int y) {
        for (int x = 0; x < deep.width(); ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(deep.width()) + std::size_t(x);
            const auto pixel = deep.samples().subspan(deep.first()[i], deep.first()[i + 1] - deep.first()[i]);
            replaced[std::size_t(y)] += tidy(pixel, !depth.back.empty(), colour.is_luminance());
        }
    });
    non_finite = 0;
    for (const std::size_t n : replaced) non_finite += n;
    return deep;
}

}  // namespace petzval
