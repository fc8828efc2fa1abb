// The bokeh texture as a picture.
#pragma once

#include "lens_sheet/subject.h"

#include <string>

namespace petzval::lens_sheet {

// Half widths of textures, in Subject::blur_um.
inline constexpr double kWholeBlurs = 10, kNearBlurs = 2.2;

// Columns from in front of focus (left) to behind, each a whole cut through a disc, divided by its brightest
// channel; rows reach one blur_um beyond the largest radius. As a data: URI.
std::string texture_uri(const Subject& subject, double blurs, int wavelengths, int width, int height);

}  // namespace petzval::lens_sheet
