// Choice of the motion vector channels of a file, and their meaning. No pixels, no OpenEXR.
#pragma once

#include "petzval/motion.h"
#include "petzval/result.h"

#include "files/channels/channel_choice.h"
#include "files/layout.h"

#include <optional>
#include <string>

namespace petzval {

// Two channels of a part, and the factors that convert them to our signs.
struct VectorChoice {
    std::size_t part = 0;
    std::string x, y;
    float sign_x = 1, sign_y = -1;
};

struct MotionChoice {
    std::optional<VectorChoice> to_previous, to_next;  // one at least
    std::string line;                                  // for Frame::detected
};

// Motion of the view of `colour`. Nothing if the file has none and none was requested by name. Errors:
// InvalidArgument for a layer that does not exist or has no two suitable channels.
Result<std::optional<MotionChoice>> choose_motion(const std::string& path, const Layout& layout,
                                                  const ColourChoice& colour, const MotionReading& reading);

}  // namespace petzval
