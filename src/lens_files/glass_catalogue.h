// The glasses that ship with the library: lenses/glasses.json, each with its source.
#pragma once

#include "petzval/result.h"

#include "lens_files/json.h"
#include "optics/glass.h"

namespace petzval::lens_files {

// Built on first use; safe from many threads.
const optics::GlassCatalogue& glass_catalogue();

// A "glasses" list as in lenses/glasses.json: name, formula ("sellmeier" with constant, B, C_um2 |
// "power_series_n2" with terms), maker, source, range_um, internal_transmittance_10mm. Other members are
// ignored: they are computed values. Errors: InvalidFile "line N: …".
Result<optics::GlassCatalogue> read_glasses(const Json& list);

}  // namespace petzval::lens_files
