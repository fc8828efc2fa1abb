#include "petzval/files.h"

#include "base/parallel.h"
#include "files/carried.h"
#include "files/exr_bands.h"
#include "files/exr_file.h"
#include "files/exr_header.h"
#include "files/exr_output.h"
#include "files/wording.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include <Imath/half.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>
#include <OpenEXR/ImfDeepTiledOutputPart.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

namespace petzval {
namespace {

// Colour as it is stored: in the file's primaries, finite, inside half's range. Counts what had to change.
class ColourSource {
public:
    ColourSource(const Frame& frame, const std::optional<PrimariesConversion>& primaries, Workers& workers)
        : frame_(frame), primaries_(primaries), workers_(workers) {}

    // `part_of_colour` 0 … 3: red, green, blue, alpha.
    void fill(BandChannel& to, int part_of_colour, int y0, int y1) {
        parallel_for(y1 - y0, workers_, [&](int row) {
            const Rgba* from = frame_.colour.row(y0 + row - frame_.place.data_window.y0);
            if (to.channel.type == SampleType::Half)
                fill_row(reinterpret_cast<Imath::half*>(to.row(row)), from, part_of_colour, kLargestHalf);
            else
                fill_row(reinterpret_cast<float*>(to.row(row)), from, part_of_colour,
                         std::numeric_limits<float>::max());
        });
    }
    WriteReport report() const { return {clamped_, non_finite_}; }

private:
    template <typename Sample>
    void fill_row(Sample* to, const Rgba* from, int part_of_colour, float largest) {
        WriteReport row;
        for (int x = 0; x < frame_.colour.width(); ++x) {
            const Rgba c = primaries_ ? transformed(primaries_->from_rec709, from[x]) : from[x];
            const float v = part_of_colour == 0   ? c.r
                            : part_of_colour == 1 ? c.g
                            : part_of_colour == 2 ? c.b
                                                  : c.a;
            to[x] = Sample(storable(v, largest, row));
        }
        if (row.clamped_to_half) clamped_ += row.clamped_to_half;
        if (row.non_finite) non_finite_ += row.non_finite;
    }

    const Frame& frame_;
    const std::optional<PrimariesConversion>& primaries_;
    Workers& workers_;
    std::atomic<std::size_t> clamped_{0}, non_finite_{0};
};

Status check_size(const Frame& frame) {
    if (frame.place.data_window.empty() || frame.place.display_window.empty())
        return Error{ErrorCode::InvalidArgument,
                     "a frame needs a data window and a display window of at least 1x1"};
    const auto fits = [&](int width, int height) { return frame.place.fits(width, height); };
    if (!fits(frame.colour.width(), frame.colour.height()))
        return Error{ErrorCode::InvalidArgument,
                     "the colour of a frame must have the size of its data window"};
    if (!frame.depth.empty() && !fits(frame.depth.width(), frame.depth.height()))
        return Error{ErrorCode::InvalidArgument,
                     "the depth of a frame must have the size of its data window"};
    return Done{};
}

void copy_floats(BandChannel& to, View<const float> plane, int first_row) {
    const int rows = int(to.bytes.size() / to.row_bytes);
    for (int y = 0; y < rows; ++y) std::memcpy(to.row(y), plane.row(first_row + y), to.row_bytes);
}

Status write_new(Imf::OStream& stream, const Frame& frame, const WriteOptions& options, Workers& workers) {
    const SampleType type = options.type == PixelType::Float ? SampleType::Float : SampleType::Half;
    std::vector<Channel> channels;
    for (const char* name : {"R", "G", "B"}) channels.push_back(plain_channel(name, type));
    if (frame.has_alpha) channels.push_back(plain_channel("A", type));
    if (!frame.depth.empty()) channels.push_back(plain_channel("Z", SampleType::Float));
    Imf::Header header = new_header(frame.place, channels);
    if (Status s = apply(options, frame.place.display_window, header); !s) return s;
    const std::optional<PrimariesConversion> rec709;
    ColourSource colour(frame, rec709, workers);
    const auto fill = [&](std::vector<BandChannel>& band, int y0, int y1) {
        const int colours = frame.has_alpha ? 4 : 3;
        for (int c = 0; c < colours; ++c) colour.fill(band[std::size_t(c)], c, y0, y1);
        if (!frame.depth.empty()) copy_floats(band.back(), frame.depth, y0 - frame.place.data_window.y0);
    };
    write_one_part(stream, header, channels, fill, workers);
    if (options.report) *options.report = colour.report();
    return Done{};
}

// Copies a whole part without decoding it.
void copy_part(Imf::MultiPartInputFile& input, int from, Imf::MultiPartOutputFile& output, int to) {
    const std::string type = input.header(from).type();
    if (type == Imf::SCANLINEIMAGE) {
        Imf::InputPart in(input, from);
        Imf::OutputPart(output, to).copyPixels(in);
    } else if (type == Imf::TILEDIMAGE) {
        Imf::TiledInputPart in(input, from);
        Imf::TiledOutputPart(output, to).copyPixels(in);
    } else if (type == Imf::DEEPSCANLINE) {
        Imf::DeepScanLineInputPart in(input, from);
        Imf::DeepScanLineOutputPart(output, to).copyPixels(in);
    } else {
        Imf::DeepTiledInputPart in(input, from);
        Imf::DeepTiledOutputPart(output, to).copyPixels(in);
    }
}

// Untouched channels of the colour's part, copied bit for bit into the windows of the output.
class CarriedSource {
public:
    CarriedSource(const ExrFile& exr, std::size_t part, const std::vector<Channel>& channels, const Rect& out,
                  std::string depth_channel)
        : path_(exr.file->path()),
          input_(*exr.parts, int(part)),
          in_(exr.layout.parts[part].data_window),
          out_(out),
          depth_channel_(std::move(depth_channel)) {
        for (const Channel& c : channels) staged_.push_back({c, {}, 0});
    }

    // Fills band[first], band[first + 1], …
    void fill(std::vector<BandChannel>& band, std::size_t first, int y0, int y1) {
        const int from = std::max(y0, in_.y0), to = std::min(y1, in_.y1);
        if (from < to && !staged_.empty()) read(from, to);
        for (std::size_t i = 0; i < staged_.size(); ++i) {
            BandChannel& target = band[first + i];
            if (in_ == out_) {
                target.bytes.swap(staged_[i].bytes);
                continue;
            }
            if (target.channel.name == depth_channel_) fill_with_misses(target);
            if (from < to) paste(staged_[i], target, from, to, y0);
        }
    }

private:
    void read(int y0, int y1) {
        resize_band(staged_, in_.width(), y1 - y0);
        Imf::FrameBuffer buffer;
        for (const BandChannel& c : staged_) buffer.insert(c.channel.name, slice_of(c, in_.x0, y0));
        const Status read = guarded(path_, [&]() -> Status {
            input_.setFrameBuffer(buffer);
            input_.readPixels(y0, y1 - 1);
            return Done{};
        });
        if (!read) throw Failure(read.error());
    }

    void paste(BandChannel& from, BandChannel& to, int y0, int y1, int band_y0) const {
        const int x0 = std::max(in_.x0, out_.x0), x1 = std::min(in_.x1, out_.x1);
        if (x0 >= x1) return;
        const std::size_t size = to.sample_bytes();
        for (int y = y0; y < y1; ++y)
            std::memcpy(to.row(y - band_y0) + size * std::size_t(x0 - out_.x0),
                        from.row(y - y0) + size * std::size_t(x0 - in_.x0), size * std::size_t(x1 - x0));
    }

    static void fill_with_misses(BandChannel& c) {
        const std::size_t count = c.bytes.size() / c.sample_bytes();
        if (c.channel.type == SampleType::Half)
            std::fill_n(reinterpret_cast<Imath::half*>(c.bytes.data()), count,
                        std::numeric_limits<Imath::half>::infinity());
        if (c.channel.type == SampleType::Float)
            std::fill_n(reinterpret_cast<float*>(c.bytes.data()), count,
                        std::numeric_limits<float>::infinity());
    }

    std::string path_;
    Imf::InputPart input_;
    Rect in_, out_;
    std::string depth_channel_;
    std::vector<BandChannel> staged_;
};

// The channels of the colour's part as they will be written: red, green, blue, alpha, then all others.
struct OutputChannels {
    std::vector<Channel> all;
    std::size_t colours = 0;
};

OutputChannels channels_of(const CarriedContent& carried, const Frame& frame, PixelType type) {
    const ColourChoice& c = carried.colour;
    const Part& part = carried.layout.parts[c.part];
    const std::string& known = c.is_luminance() ? c.luminance : c.red;
    const std::string prefix =
        known.substr(0, known.rfind('.') == std::string::npos ? 0 : known.rfind('.') + 1);
    const Channel* like = part.find(known);
    SampleType stored = like && like->type == SampleType::Float ? SampleType::Float : SampleType::Half;
    if (type != PixelType::Keep) stored = type == PixelType::Float ? SampleType::Float : SampleType::Half;
    OutputChannels out;
    const auto add = [&](const std::string& name, const char* otherwise) {
        out.all.push_back(plain_channel(name.empty() ? prefix + otherwise : name, stored));
    };
    add(c.red, "R");
    add(c.green, "G");
    add(c.blue, "B");
    if (frame.has_alpha) add(c.alpha, "A");
    out.colours = out.all.size();
    if (part.deep) return out;  // samples cannot be carried in a flat file
    for (const Channel& channel : part.channels) {
        const bool replaced = std::any_of(out.all.begin(), out.all.end(),
                                          [&](const Channel& o) { return o.name == channel.name; });
        const bool was_colour = channel.name == c.luminance || channel.name == c.chroma_r ||
                                channel.name == c.chroma_b || channel.name == c.alpha;
        if (!replaced && !was_colour) out.all.push_back(channel);
    }
    return out;
}

Status write_carried(Imf::OStream& stream, const Frame& frame, const WriteOptions& options,
                     Workers& workers) {
    const CarriedContent& carried = *frame.carried;
    Result<ExrFile> opened = ExrFile::open(carried.file, carried.max_pixels, workers);
    if (!opened) return opened.error();
    ExrFile& exr = *opened;
    const std::size_t part = carried.colour.part;
    if (!same_pixels(exr.layout, carried.layout))
        return invalid_file(carried.file->path(), "changed since it was read");
    const OutputChannels channels = channels_of(carried, frame, options.type);
    const bool same_window = exr.layout.parts[part].data_window == frame.place.data_window;
    for (const Channel& c : channels.all)
        if (c.subsampled() && !same_window)
            return Error{ErrorCode::Unsupported,
                         "channel '" + printable(c.name) +
                             "' is subsampled and cannot be kept in another data window"};

    std::vector<Imf::Header> headers;
    std::vector<int> source;  // part of the input for each part of the output
    std::size_t colour_out = 0;
    for (int p = 0; p < exr.parts->parts(); ++p) {
        const Part& description = exr.layout.parts[std::size_t(p)];
        if (!description.readable || !description.complete) continue;
        if (std::size_t(p) == part) colour_out = headers.size();
        headers.push_back(std::size_t(p) == part
                              ? colour_header(exr.parts->header(p), frame, channels.all, channels.colours)
                              : kept_header(exr.parts->header(p), frame));
        source.push_back(p);
    }
    if (Status s = apply(options, frame.place.display_window, headers[colour_out]); !s) return s;

    ColourSource colour(frame, carried.primaries, workers);
    std::optional<CarriedSource> others;
    if (!exr.layout.parts[part].deep)
        others.emplace(
            exr, part,
            std::vector<Channel>(channels.all.begin() + std::ptrdiff_t(channels.colours), channels.all.end()),
            frame.place.data_window, carried.depth_channel);
    const auto fill = [&](std::vector<BandChannel>& band, int y0, int y1) {
        for (std::size_t c = 0; c < channels.colours; ++c) colour.fill(band[c], int(c), y0, y1);
        if (others) others->fill(band, channels.colours, y0, y1);
    };
    if (headers.size() == 1) {
        write_one_part(stream, headers[0], channels.all, fill, workers);
    } else {
        Imf::MultiPartOutputFile output(stream, headers.data(), int(headers.size()), false,
                                        exr_threads(workers));
        for (std::size_t p = 0; p < headers.size(); ++p)
            if (p == colour_out)
                write_bands(output, int(p), channels.all, fill);
            else
                copy_part(*exr.parts, source[p], output, int(p));
    }
    if (options.report) *options.report = colour.report();
    return Done{};
}

}  // namespace

Status write_exr(const std::string& path, const Frame& frame, const WriteOptions& options) {
    if (Status s = check_size(frame); !s) return s;
    const std::shared_ptr<Workers> workers = workers_of(options.threads, options.workers);
    return write_exr_file(path, options.overwrite, [&](Imf::OStream& stream) {
        return frame.carried ? write_carried(stream, frame, options, *workers)
                             : write_new(stream, frame, options, *workers);
    });
}

Status write_exr_planes(const std::string& path, const Place& place, const std::vector<NamedPlane>& planes,
                        const WriteOptions& options) {
    if (planes.empty() || !check(place))
        return Error{ErrorCode::InvalidArgument, "planes, a data window and a display window are needed"};
    std::vector<Channel> channels;
    for (const NamedPlane& p : planes) {
        if (p.channel.empty() || !place.fits(p.plane.width(), p.plane.height()))
            return Error{ErrorCode::InvalidArgument,
                         "plane '" + printable(p.channel) + "' needs a name and the size of the data window"};
        channels.push_back(plain_channel(p.channel, SampleType::Float));
    }
    const std::shared_ptr<Workers> workers = workers_of(options.threads, options.workers);
    return write_exr_file(path, options.overwrite, [&](Imf::OStream& stream) -> Status {
        Imf::Header header = new_header(place, channels);
        if (Status s = apply(options, place.display_window, header); !s) return s;
        const auto fill = [&](std::vector<BandChannel>& band, int y0, int) {
            for (std::size_t i = 0; i < planes.size(); ++i)
                copy_floats(band[i], planes[i].plane, y0 - place.data_window.y0);
        };
        write_one_part(stream, header, channels, fill, *workers);
        return Done{};
    });
}

}  // namespace petzval
