// Texts for sizes in this room.
#pragma once

#include "petzval/image.h"

#include <string>

namespace petzval::shot {

inline std::string window_text(const Rect& r) {
    return std::to_string(r.width()) + " x " + std::to_string(r.height()) + " pixels at " +
           std::to_string(r.x0) + "," + std::to_string(r.y0);
}

}  // namespace petzval::shot
