// Which channels of a file are motion vectors, and what they mean. No pixels, no OpenEXR.
#pragma once

#include "petzval/motion.h"
#include "petzval/result.h"

#include "files/channel_choice.h"
#include "files/layout.h"

#include <optional>
#include <string>

namespace petzval {

// Two channels of a part, and what makes of them a move by our signs.
struct VectorChoice {
    std::size_t part = 0;
    std::string x, y;
    float sign_x = 1, sign_y = -1;
};

struct MotionChoice {
    std::optional<VectorChoice> to_previous, to_next;  // one at least
    std::string line;                                  // for Frame::detected
};

// Of the view of `colour`. Nothing where the file has none and none was asked for by name. Errors:
// InvalidArgument for a layer that the file does not have, or that has no two channels of the right names.
Result<std::optional<MotionChoice>> choose_motion(const std::string& path, const Layout& layout,
                                                  const ColourChoice& colour, const MotionReading& reading);

}  // namespace petzval
