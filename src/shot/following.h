// Surfaces followed along motion vectors.
#pragma once

#include "shot/landing.h"

#include <span>
#include <string>
#include <vector>

namespace petzval::shot {

// The frames from another picture to the shot whose vectors can be asked, that of the other picture first.
using Steps = std::vector<OtherPicture>;
Steps steps_of(const OtherPicture& other, std::span<const OtherPicture> all);

// Follows a pixel of the first step along the vectors, times `signs`, to the window of the shot. If an
// intermediate frame hides its surface, the last motion continues.
Landing carried(const Steps& steps, int x, int y, const Rect& to, PixelMove signs = {1, 1});

// Vectors may point down instead of up, or lead to the wrong frame. A sentence if moving pixels look clearly
// more alike by vectors of other signs; else empty.
std::string note_of_signs(const OtherPicture& other, std::span<const OtherPicture> all, const Shot& shot);

}  // namespace petzval::shot
