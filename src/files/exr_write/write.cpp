#include "petzval/files.h"

#include "base/parallel.h"
#include "files/exr/file.h"
#include "files/exr_write/bands.h"
#include "files/exr_write/carry.h"
#include "files/exr_write/header.h"
#include "files/exr_write/output.h"
#include "files/exr_write/paint.h"
#include "files/wording.h"

#include <cstring>

namespace petzval {
namespace {

Status check_size(const Frame& frame) {
    if (frame.place.data_window.empty() || frame.place.display_window.empty())
        return Error{ErrorCode::InvalidArgument,
                     "a frame needs a data window and a display window of at least 1x1"};
    const auto fits = [&](int width, int height) { return frame.place.fits(width, height); };
    if (!fits(frame.colour.width(), frame.colour.height()))
        return Error{ErrorCode::InvalidArgument,
                     "the colour of a frame must have the size of its data window"};
    for (const FrameLayer& layer : frame.layers)
        if (!fits(layer.colour.width(), layer.colour.height()))
            return Error{ErrorCode::InvalidArgument,
                         "the layers of a frame must have the size of its data window"};
    if (!frame.depth.empty() && !fits(frame.depth.width(), frame.depth.height()))
        return Error{ErrorCode::InvalidArgument,
                     "the depth of a frame must have the size of its data window"};
    for (const Image<PixelMove>* moves : {&frame.motion.to_next, &frame.motion.to_previous})
        if (!moves->empty() && !fits(moves->width(), moves->height()))
            return Error{ErrorCode::InvalidArgument,
                         "the motion of a frame must have the size of its data window"};
    return Done{};
}

void copy_floats(BandChannel& to, View<const float> plane, int first_row) {
    const int rows = int(to.bytes.size() / to.row_bytes);
    for (int y = 0; y < rows; ++y) std::memcpy(to.row(y), plane.row(first_row + y), to.row_bytes);
}

// A component of the vectors to one frame around, y upwards as others have it.
struct MotionChannel {
    std::string name;
    const Image<PixelMove>* moves;
    bool is_x;
};

std::vector<MotionChannel> motion_channels(const MotionVectors& motion) {
    std::vector<MotionChannel> channels;
    for (const auto& [name, moves] :
         {std::pair{"forward", &motion.to_next}, {"backward", &motion.to_previous}})
        if (!moves->empty())
            for (const bool is_x : {true, false})
                channels.push_back({std::string(name) + (is_x ? ".u" : ".v"), moves, is_x});
    return channels;
}

void copy_moves(BandChannel& to, const MotionChannel& from, int first_row) {
    const int rows = int(to.bytes.size() / to.row_bytes), width = from.moves->width();
    std::vector<float> values(std::size_t(width), 0.f);
    for (int y = 0; y < rows; ++y) {
        const PixelMove* moves = from.moves->row(first_row + y);
        for (int x = 0; x < width; ++x) values[std::size_t(x)] = from.is_x ? moves[x].x : -moves[x].y;
        std::memcpy(to.row(y), values.data(), to.row_bytes);
    }
}

Status write_new(Imf::OStream& stream, const Frame& frame, const WriteOptions& options, Workers& workers) {
    const ChannelType type = options.type == PixelType::Float ? ChannelType::Float : ChannelType::Half;
    std::vector<Channel> channels;
    for (const char* name : {"R", "G", "B"}) channels.push_back(plain_channel(name, type));
    if (frame.has_alpha) channels.push_back(plain_channel("A", type));
    if (!frame.depth.empty()) channels.push_back(plain_channel("Z", ChannelType::Float));
    const std::vector<MotionChannel> motion = motion_channels(frame.motion);
    for (const MotionChannel& m : motion) channels.push_back(plain_channel(m.name, ChannelType::Float));
    Imf::Header header = new_header(frame.place, channels);
    if (Status s = apply(options, frame.place.display_window, header); !s) return s;
    Painter painter(workers);
    const auto fill = [&](std::vector<BandChannel>& band, int y0, int y1) {
        const int colours = frame.has_alpha ? 4 : 3;
        for (int c = 0; c < colours; ++c)
            painter.fill(band[std::size_t(c)], {channels[std::size_t(c)], &frame.colour, c},
                         frame.place.data_window.y0, y0, y1);
        std::size_t next = std::size_t(colours);
        const int first_row = y0 - frame.place.data_window.y0;
        if (!frame.depth.empty()) copy_floats(band[next++], frame.depth, first_row);
        for (const MotionChannel& m : motion) copy_moves(band[next++], m, first_row);
    };
    write_one_part(stream, header, channels, fill, workers);
    if (options.report) *options.report = painter.report();
    return Done{};
}

}  // namespace

Status write_exr(const std::string& path, const Frame& frame, const WriteOptions& options) {
    if (frame.carried) return write_exr_views(path, {&frame}, options);
    if (Status s = check_size(frame); !s) return s;
    const std::shared_ptr<Workers> workers = workers_of(options.threads, options.workers);
    return write_exr_file(path, options.overwrite,
                          [&](Imf::OStream& stream) { return write_new(stream, frame, options, *workers); });
}

Status write_exr_views(const std::string& path, const std::vector<const Frame*>& frames,
                       const WriteOptions& options) {
    for (const Frame* frame : frames) {
        if (Status s = check_size(*frame); !s) return s;
        if (!frame->carried)
            return Error{ErrorCode::InvalidArgument,
                         "only a file that was read can be written with several views"};
    }
    if (frames.empty()) return Error{ErrorCode::InvalidArgument, "views must not be empty"};
    const std::shared_ptr<Workers> workers = workers_of(options.threads, options.workers);
    return write_exr_file(path, options.overwrite, [&](Imf::OStream& stream) {
        return write_carried(stream, frames, options, *workers);
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
        channels.push_back(plain_channel(p.channel, ChannelType::Float));
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
