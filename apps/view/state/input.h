// Files of the shot, as chosen in the window, and a camera for files without one.
#pragma once

#include "petzval/shot.h"

#include "view.h"

#include <optional>
#include <string>

namespace petzval::view {

// Origin of a camera number that no file and no user gave.
inline const std::string kAssumed = "assumed";
bool is_assumed(const std::optional<FoundNumber>& number);
// Fills in numbers missing in the file: 50 mm (or what its field of view gives), 36 mm, f/2.8, focus on the
// median of the 5 x 5 pixels in the middle, or at 1 m without depth.
void assume_missing_numbers(Shot& shot, const CameraChoice& user);

struct OpenedShot {
    Shot shot;
    std::string no_depth;  // why its depth could not be read; empty: it was
};
// The shot, without depth if only that cannot be read. Errors: those of read_shot() of files that have no
// readable picture either.
Result<OpenedShot> read_anything(ShotSource source);

}  // namespace petzval::view
