#include "files/exr/motion.h"

#include "files/channels/motion_choice.h"
#include "files/exr/pixels.h"
#include "files/memory_limit.h"

#include <cmath>
#include <limits>

namespace petzval {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

Result<Image<PixelMove>> read_vector(const ExrFile& exr, const VectorChoice& choice,
                                     const MotionReading& reading, const Rect& window) {
    const Rect own = exr.layout.parts[choice.part].data_window;
    auto moves = Image<PixelMove>::uninitialised(own.width(), own.height());
    const std::ptrdiff_t row = 2 * std::ptrdiff_t(own.width());
    if (Status s =
            read_floats(exr, choice.part,
                        {{choice.x, &moves.pixels()->x, 2, row}, {choice.y, &moves.pixels()->y, 2, row}});
        !s)
        return s.error();
    const float x = choice.sign_x * float(reading.scale_x), y = choice.sign_y * float(reading.scale_y);
    for (std::size_t i = 0; i < moves.size(); ++i) {
        PixelMove& m = moves.pixels()[i];
        m = {m.x * x, m.y * y};
        if (!std::isfinite(m.x) || !std::isfinite(m.y)) m = {kUnknown, kUnknown};
    }
    return own == window ? std::move(moves)
                         : through_window(moves, own, window, PixelMove{kUnknown, kUnknown});
}

}  // namespace

Status read_motion(const ExrFile& exr, const ColourChoice& colour, const ReadOptions& options, Frame& frame) {
    if (!options.motion.wanted) return Done{};
    const auto found = choose_motion(exr.file->path(), exr.layout, colour, options.motion);
    if (!found) return found.error();
    if (!*found) return Done{};
    const MotionChoice& choice = **found;
    const Rect& window = frame.place.data_window;
    const std::size_t ways = std::size_t(choice.to_next.has_value() + choice.to_previous.has_value());
    if (Status s =
            fits_memory(*exr.file, window, sizeof(Rgba) + sizeof(float) + ways * sizeof(PixelMove), options);
        !s)
        return s;
    for (const auto& [way, moves] : {std::pair{&choice.to_next, &frame.motion.to_next},
                                     {&choice.to_previous, &frame.motion.to_previous}}) {
        if (!*way) continue;
        auto read = read_vector(exr, **way, options.motion, window);
        if (!read) return read.error();
        *moves = std::move(*read);
    }
    frame.detected.push_back(choice.line);
    return Done{};
}

}  // namespace petzval
