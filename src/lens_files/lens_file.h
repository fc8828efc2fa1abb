// Reading lenses: a prescription, or aberration curves, from the text of any format we know, recognised by
// its content.
//
//   own JSON        one entry of a lens list saved alone; lenses/*.json in this repository are examples;
//                   or longitudinal aberration curves instead of surfaces (docs/reference/lens-files.md)
//   Zemax .zmx      sequential, refracting, rotationally symmetric
//   CODE V .seq     likewise
//   pbrt .dat       radius, thickness, index, aperture diameter; stop has radius 0
//   Optical Bench   the tab-separated text of photonstophotos.net
//   table           radius, thickness, glass or nd and Vd, diameter, as patents print them
//
// What changes the light's path and is not understood (mirrors, tilts, unknown surface types or glass) is an
// error that names the line; what does not is listed in the warnings.
#pragma once

#include "petzval/result.h"

#include "optics/aberration_curves.h"
#include "optics/prescription.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace petzval::lens_files {

struct LensFile {
    optics::Prescription lens;                                 // of a lens drawn as curves only the texts
    std::optional<optics::AberrationCurves> curves;            // instead of surfaces
    std::string format;                                        // as in the list above
    std::vector<std::string> warnings;                         // one sentence each, for the user
    double printed_focal_length_mm = 0, printed_f_number = 0;  // beside the surfaces; 0: none
    std::string content_key;                                   // names the bytes it was read from
};

inline constexpr std::size_t kLargestLensFile = 2 << 20;  // bytes

// `name` stands in front of every message: "NAME: line 3: …". The lens or its curves have passed
// optics::check.
// Errors: InvalidFile for damaged or unsupported content, or bytes that are none of the formats.
Result<LensFile> read_lens(std::string_view bytes, const std::string& name);

// Errors: InvalidFile when the file is missing, unreadable, no regular file, empty or too large; those of
// read_lens.
Result<LensFile> load_lens_file(const std::string& path);

}  // namespace petzval::lens_files
