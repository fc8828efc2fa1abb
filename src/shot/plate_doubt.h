// A clean plate compared with its picture.
#pragma once

#include "petzval/shot.h"

#include <string>

namespace petzval::shot {

// A sentence if the plate, shot.behind, can hardly be that of the picture: swapped files, another unit,
// another frame or exposure, or nothing behind. Else empty. depth_m: of the picture.
std::string plate_doubt(const Shot& shot, View<const float> depth_m);

}  // namespace petzval::shot
