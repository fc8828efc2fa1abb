#include "files/exr_write/carry.h"

#include "files/carried.h"
#include "files/exr/chunks.h"
#include "files/exr/file.h"
#include "files/exr_write/bands.h"
#include "files/exr_write/header.h"
#include "files/exr_write/output.h"
#include "files/exr_write/paint.h"
#include "files/wording.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <Imath/half.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>
#include <OpenEXR/ImfDeepTiledOutputPart.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>

namespace petzval {
namespace {

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

// Output of a part of which at least one channel is replaced.
struct PartOutput {
    const Frame* frame = nullptr;  // in whose window
    std::vector<Painted> painted;
    std::vector<Channel> carried;
    std::set<std::string> depths;   // of the carried
    std::set<std::string> dropped;  // written under other names, or as part of other channels

    std::vector<Channel> channels() const {
        std::vector<Channel> all;
        for (const Painted& p : painted) all.push_back(p.channel);
        all.insert(all.end(), carried.begin(), carried.end());
        return all;
    }
};

// Untouched channels of such a part, copied bit for bit into the windows of the output.
class CarriedSource {
public:
    CarriedSource(const ExrFile& exr, std::size_t part, const std::vector<Channel>& channels, const Rect& out,
                  std::set<std::string> depths)
        : exr_(exr),
          part_(part),
          in_(exr.layout.parts[part].data_window),
          out_(out),
          depths_(std::move(depths)) {
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
            if (depths_.contains(target.channel.name)) fill_with_misses(target);
            if (from < to) paste(staged_[i], target, from, to, y0);
        }
    }

private:
    void read(int y0, int y1) {
        resize_band(staged_, in_.width(), y1 - y0);
        const Status read = guarded(*exr_.file, [&] {
            if (!chunks_ && !input_) chunks_.emplace(exr_, part_);
            if (chunks_ && chunks_->can_be_unpacked()) return read_unpacked(y0, y1);
            if (chunks_) chunks_.reset(), input_.emplace(*exr_.parts, int(part_));
            return read_by_openexr(y0, y1);
        });
        if (!read) throw Failure(read.error());
    }
    Status read_unpacked(int y0, int y1) {
        std::vector<std::string> names;
        for (const BandChannel& c : staged_) names.push_back(c.channel.name);
        return chunks_->for_pixels(names, y0, y1, [&](std::size_t n, const FlatChunks::Row& row) {
            const std::size_t size = staged_[n].sample_bytes();
            std::memcpy(staged_[n].row(row.y - y0) + size * std::size_t(row.x - in_.x0), row.samples,
                        size * std::size_t(row.width));
        });
    }
    Status read_by_openexr(int y0, int y1) {
        Imf::FrameBuffer buffer;
        for (const BandChannel& c : staged_) buffer.insert(c.channel.name, slice_of(c, in_.x0, y0));
        input_->setFrameBuffer(buffer);
        input_->readPixels(y0, y1 - 1);
        return Done{};
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
        if (c.channel.type == ChannelType::Half)
            std::fill_n(reinterpret_cast<Imath::half*>(c.bytes.data()), count,
                        std::numeric_limits<Imath::half>::infinity());
        if (c.channel.type == ChannelType::Float)
            std::fill_n(reinterpret_cast<float*>(c.bytes.data()), count,
                        std::numeric_limits<float>::infinity());
    }

    const ExrFile& exr_;
    std::size_t part_;
    std::optional<FlatChunks> chunks_;  // or OpenEXR's part: it opens one only as one thing
    std::optional<Imf::InputPart> input_;
    Rect in_, out_;
    std::set<std::string> depths_;
    std::vector<BandChannel> staged_;
};

bool is_grey(const Picture& picture) {
    return std::all_of(picture.pixels(), picture.pixels() + picture.size(),
                       [](Rgba c) { return c.r == c.g && c.g == c.b; });
}

// Says for each part what is painted there.
class Plan {
public:
    explicit Plan(const WriteOptions& options) : options_(options) {}

    // Errors: InvalidArgument where layers are not those that were read, or views of a part differ in window.
    Status add(const Frame& frame) {
        const CarriedContent& carried = *frame.carried;
        if (!frame.layers.empty() && frame.layers.size() != carried.layers.size())
            return Error{ErrorCode::InvalidArgument, "the layers of a frame must be those that were read"};
        if (Status s = add_colour(frame, carried); !s) return s;
        for (std::size_t i = 0; i < frame.layers.size(); ++i)
            if (Status s = add_layer(frame, frame.layers[i], carried.layers[i]); !s) return s;
        return Done{};
    }
    // All else of those parts is carried.
    void finish(const Layout& layout) {
        for (auto& [part, out] : parts) {
            if (layout.parts[part].deep) continue;  // samples cannot be carried in a flat file
            for (const Channel& channel : layout.parts[part].channels) {
                const bool replaced =
                    std::any_of(out.painted.begin(), out.painted.end(),
                                [&](const Painted& p) { return p.channel.name == channel.name; });
                if (!replaced && !out.dropped.contains(channel.name)) out.carried.push_back(channel);
            }
        }
    }
    std::map<std::size_t, PartOutput> parts;
    bool became_rgb = false;  // luminance, written as red, green, blue

private:
    Result<PartOutput*> part_of(const Frame& frame, std::size_t part) {
        PartOutput& out = parts[part];
        if (!out.frame) out.frame = &frame;
        if (!(out.frame->place == frame.place))
            return Error{ErrorCode::InvalidArgument, "views of one part must have one data window"};
        return &out;
    }

    ChannelType type_of(const CarriedContent& carried, std::size_t part, const std::string& like) const {
        const Channel* channel = carried.layout.parts[part].find(like);
        const bool is_float = options_.type == PixelType::Keep
                                  ? channel && channel->type == ChannelType::Float
                                  : options_.type == PixelType::Float;
        return is_float ? ChannelType::Float : ChannelType::Half;
    }

    Status add_colour(const Frame& frame, const CarriedContent& carried) {
        const ColourChoice& c = carried.colour;
        const auto out = part_of(frame, c.part);
        if (!out) return out.error();
        const std::string& known = c.is_luminance() ? c.luminance : c.red;
        const std::size_t dot = known.rfind('.');
        const std::string prefix = known.substr(0, dot == std::string::npos ? 0 : dot + 1);
        const ChannelType type = type_of(carried, c.part, known);
        const PrimariesConversion* primaries = carried.primaries ? &*carried.primaries : nullptr;
        const auto paint = [&](const std::string& name, const char* otherwise, int component) {
            (*out)->painted.push_back({plain_channel(name.empty() ? prefix + otherwise : name, type),
                                       &frame.colour, component, primaries});
        };
        if (c.is_luminance() && c.chroma_r.empty() && is_grey(frame.colour)) {
            paint(c.luminance, "Y", 0);
        } else {
            paint(c.red, "R", 0), paint(c.green, "G", 1), paint(c.blue, "B", 2);
            became_rgb = became_rgb || c.is_luminance();
        }
        if (frame.has_alpha) paint(c.alpha, "A", 3);
        for (const std::string& was : {c.luminance, c.chroma_r, c.chroma_b, c.alpha})
            if (!was.empty()) (*out)->dropped.insert(was);
        if (!carried.depth_channel.empty()) (*out)->depths.insert(carried.depth_channel);
        return Done{};
    }

    Status add_layer(const Frame& frame, const FrameLayer& layer, const LayerChoice& choice) {
        const CarriedContent& carried = *frame.carried;
        const auto out = part_of(frame, choice.part);
        if (!out) return out.error();
        for (int c = 0; c < 4; ++c) {
            const std::string& name = choice.channels[std::size_t(c)];
            if (name.empty()) continue;
            (*out)->painted.push_back(
                {plain_channel(name, type_of(carried, choice.part, name)), &layer.colour, c,
                 choice.is_colour && carried.primaries ? &*carried.primaries : nullptr});
        }
        return Done{};
    }

    const WriteOptions& options_;
};

// Errors: Unsupported for subsampled channels in a part that gets another window.
Status check_subsampled(const Layout& layout, const Plan& plan) {
    for (const auto& [part, out] : plan.parts)
        for (const Channel& c : out.carried)
            if (c.subsampled() && layout.parts[part].data_window != out.frame->place.data_window)
                return Error{ErrorCode::Unsupported,
                             "channel '" + printable(c.name) +
                                 "' is subsampled and cannot be kept in another data window"};
    return Done{};
}

// Fills the bands of such a part.
class PartPainter {
public:
    PartPainter(const ExrFile& exr, std::size_t part, const PartOutput& out, Painter& painter)
        : out_(out), painter_(painter) {
        if (!exr.layout.parts[part].deep)
            others_.emplace(exr, part, out.carried, out.frame->place.data_window, out.depths);
    }
    void operator()(std::vector<BandChannel>& band, int y0, int y1) {
        const int first = out_.frame->place.data_window.y0;
        for (std::size_t c = 0; c < out_.painted.size(); ++c)
            painter_.fill(band[c], out_.painted[c], first, y0, y1);
        if (others_) others_->fill(band, out_.painted.size(), y0, y1);
    }

private:
    const PartOutput& out_;
    Painter& painter_;
    std::optional<CarriedSource> others_;
};

void write_parts(Imf::OStream& stream, ExrFile& exr, const Plan& plan,
                 const std::vector<Imf::Header>& headers, const std::vector<int>& source, Painter& painter,
                 Workers& workers) {
    std::optional<Imf::MultiPartOutputFile> output;
    if (headers.size() > 1)
        output.emplace(stream, headers.data(), int(headers.size()), false, exr_threads(workers));
    for (std::size_t p = 0; p < headers.size(); ++p) {
        const auto out = plan.parts.find(std::size_t(source[p]));
        if (out == plan.parts.end()) {
            // An error here is the input's: the output reports its own errors (exr_write/output.h).
            const Status copied = guarded(*exr.file, [&] {
                copy_part(*exr.parts, source[p], *output, int(p));
                return Status(Done{});
            });
            if (!copied) throw Failure(copied.error());
            continue;
        }
        PartPainter paint(exr, out->first, out->second, painter);
        const FillBand fill = [&](std::vector<BandChannel>& band, int y0, int y1) { paint(band, y0, y1); };
        if (output)
            write_bands(*output, int(p), out->second.channels(), fill);
        else
            write_one_part(stream, headers[p], out->second.channels(), fill, workers);
    }
}

}  // namespace

Status write_carried(Imf::OStream& stream, std::span<const Frame* const> frames, const WriteOptions& options,
                     Workers& workers) {
    const CarriedContent& carried = *frames.front()->carried;
    Result<ExrFile> opened = ExrFile::open(carried.file, carried.max_pixels, workers);
    if (!opened) return opened.error();
    ExrFile& exr = *opened;
    Plan plan(options);
    for (const Frame* frame : frames) {
        if (!same_pixels(exr.layout, frame->carried->layout))
            return invalid_file(carried.file->path(), "changed since it was read");
        if (Status s = plan.add(*frame); !s) return s;
    }
    plan.finish(exr.layout);
    if (Status s = check_subsampled(exr.layout, plan); !s) return s;

    std::vector<Imf::Header> headers;
    std::vector<int> source;  // part of the input for each part of the output
    for (int p = 0; p < exr.parts->parts(); ++p) {
        const Part& description = exr.layout.parts[std::size_t(p)];
        if (!description.readable || !description.complete) continue;
        const auto out = plan.parts.find(std::size_t(p));
        headers.push_back(out == plan.parts.end()
                              ? kept_header(exr.parts->header(p), *frames.front())
                              : colour_header(exr.parts->header(p), *out->second.frame,
                                              out->second.channels(), out->second.painted.size()));
        for (const Frame* frame : frames)
            if (std::size_t(p) == frame->carried->colour.part)
                if (Status s = apply(options, frame->place.display_window, headers.back()); !s) return s;
        source.push_back(p);
    }
    Painter painter(workers);
    write_parts(stream, exr, plan, headers, source, painter, workers);
    if (options.report) {
        *options.report = painter.report();
        options.report->became_rgb = plan.became_rgb;
    }
    return Done{};
}

}  // namespace petzval
