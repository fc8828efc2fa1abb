#include "petzval/files.h"

#include "base/parallel.h"
#include "files/exr/file.h"
#include "files/exr_write/header.h"
#include "files/exr_write/output.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <limits>

#include <Imath/half.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfPartType.h>

namespace petzval {
namespace {

constexpr int kBandRows = 64;

// The samples of some rows, one array per channel, as OpenEXR wants to be handed them.
template <typename Sample>
class DeepBand {
public:
    DeepBand(const DeepPicture& deep, const Rect& window, bool has_back, WriteReport& report)
        : deep_(deep), window_(window), has_back_(has_back), report_(report) {}

    Imf::DeepFrameBuffer fill(int y0, int y1) {
        const std::size_t width = std::size_t(deep_.width());
        const std::size_t first_pixel = std::size_t(y0) * width, pixels = std::size_t(y1 - y0) * width;
        const std::size_t first = deep_.first()[first_pixel];
        const auto samples = deep_.samples().subspan(first, deep_.first()[first_pixel + pixels] - first);
        counts_.resize(pixels);
        for (std::size_t i = 0; i < pixels; ++i)
            counts_[i] = unsigned(deep_.first()[first_pixel + i + 1] - deep_.first()[first_pixel + i]);
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(
            Imf::Slice(Imf::UINT, base(counts_.data(), y0), sizeof(unsigned), sizeof(unsigned) * width));
        const float largest = sizeof(Sample) == 2 ? 65504.f : std::numeric_limits<float>::max();
        const auto add = [&](std::size_t c, const char* name, Imf::PixelType type, auto& stored, auto value) {
            stored.resize(samples.size());
            for (std::size_t i = 0; i < samples.size(); ++i)
                stored[i] = std::remove_reference_t<decltype(stored[0])>(value(samples[i]));
            pointers_[c].resize(pixels);
            for (std::size_t i = 0; i < pixels; ++i)
                pointers_[c][i] =
                    reinterpret_cast<char*>(stored.data() + (deep_.first()[first_pixel + i] - first));
            buffer.insert(name, Imf::DeepSlice(type, base(pointers_[c].data(), y0), sizeof(char*),
                                               sizeof(char*) * width, sizeof(stored[0])));
        };
        const auto colour = [&](float v) { return storable(v, largest, report_); };
        const Imf::PixelType type = sizeof(Sample) == 2 ? Imf::HALF : Imf::FLOAT;
        add(0, "R", type, colours_[0], [&](const DeepSample& s) { return colour(s.colour.r); });
        add(1, "G", type, colours_[1], [&](const DeepSample& s) { return colour(s.colour.g); });
        add(2, "B", type, colours_[2], [&](const DeepSample& s) { return colour(s.colour.b); });
        add(3, "A", type, colours_[3], [&](const DeepSample& s) { return colour(s.colour.a); });
        add(4, "Z", Imf::FLOAT, depths_[0], [](const DeepSample& s) { return s.depth; });
        if (has_back_)
            add(5, "ZBack", Imf::FLOAT, depths_[1], [](const DeepSample& s) { return s.depth_back; });
        return buffer;
    }

private:
    template <typename T>
    char* base(T* first, int y0) const {
        const std::intptr_t offset = window_.x0 + std::intptr_t(window_.y0 + y0) * window_.width();
        return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(first) -
                                       std::intptr_t(sizeof(T)) * offset);
    }

    const DeepPicture& deep_;
    Rect window_;
    bool has_back_;
    WriteReport& report_;
    std::vector<unsigned> counts_;
    std::array<std::vector<char*>, 6> pointers_;
    std::array<std::vector<Sample>, 4> colours_;
    std::array<std::vector<float>, 2> depths_;
};

template <typename Sample>
void write_samples(Imf::MultiPartOutputFile& output, const DeepPicture& deep, const Rect& window,
                   bool has_back, WriteReport& report) {
    Imf::DeepScanLineOutputPart out(output, 0);
    DeepBand<Sample> band(deep, window, has_back, report);
    for (int y = 0; y < deep.height(); y += kBandRows) {
        const int end = std::min(y + kBandRows, deep.height());
        out.setFrameBuffer(band.fill(y, end));
        out.writePixels(end - y);
    }
}

}  // namespace

Status write_deep_exr(const std::string& path, const Place& place, const DeepPicture& deep,
                      const WriteOptions& options) {
    if (!check(place) || !place.fits(deep.width(), deep.height()))
        return Error{ErrorCode::InvalidArgument,
                     "a deep picture must have the size of its data window, at least 1x1"};
    const std::string compression = options.compression.empty() ? "zips" : lower(options.compression);
    if (compression != "none" && compression != "rle" && compression != "zips")
        return Error{ErrorCode::InvalidArgument, "a deep EXR takes compression none, rle or zips, not '" +
                                                     printable(options.compression) + "'"};
    const bool wide = options.type == PixelType::Float;
    const bool has_back = std::any_of(deep.samples().begin(), deep.samples().end(),
                                      [](const DeepSample& s) { return s.depth_back != s.depth; });
    std::vector<Channel> channels;
    for (const char* name : {"R", "G", "B", "A"})
        channels.push_back(plain_channel(name, wide ? ChannelType::Float : ChannelType::Half));
    channels.push_back(plain_channel("Z", ChannelType::Float));
    if (has_back) channels.push_back(plain_channel("ZBack", ChannelType::Float));
    return write_exr_file(path, options.overwrite, [&](Imf::OStream& stream) -> Status {
        Imf::Header header = new_header(place, channels);
        header.setType(Imf::DEEPSCANLINE);
        WriteOptions chosen = options;
        chosen.compression = compression;
        if (Status s = apply(chosen, place.display_window, header); !s) return s;
        WriteReport report;
        Imf::MultiPartOutputFile output(stream, &header, 1, false,
                                        exr_threads(*workers_of(options.threads, options.workers)));
        if (wide)
            write_samples<float>(output, deep, place.data_window, has_back, report);
        else
            write_samples<Imath::half>(output, deep, place.data_window, has_back, report);
        if (options.report) *options.report = report;
        return Done{};
    });
}

}  // namespace petzval
