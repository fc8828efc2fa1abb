// Metadata of PNG, JPEG and TIFF that changes the picture.
#pragma once

#include "files/raster/raster.h"

#include <span>
#include <string>

namespace petzval {

using TagBytes = std::span<const unsigned char>;

// 1 … 8 of EXIF data as it stands in a JPEG's APP1 marker ("Exif", two zeros, a TIFF header and directory:
// CIPA DC-008, "Exif"); 1 where it says nothing or is damaged.
int orientation_of_exif(TagBytes marker);

// The picture with its first row at the top and its first column at the left; orientation 1 from then on.
Raster upright(Raster raster);

// A sentence if the profile is not sRGB's, by its name; petzval takes codes through one transfer curve and
// Rec. 709 primaries. Empty for no profile.
std::string note_of_profile(TagBytes icc);

// Appends a sentence.
void add_note(std::string& notes, const std::string& note);

}  // namespace petzval
