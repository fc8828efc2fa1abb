// The curves of a lens, bent by hand: where along the axis each zone of the pupil and each wavelength
// focuses.
#pragma once

#include "petzval/lens_choice.h"
#include "petzval/lens_facts.h"
#include "petzval/result.h"

#include <string>

namespace petzval::view {

struct BentLens {
    double focal_length_mm = 0, f_number = 0, sensor_width_mm = 36;
    LongitudinalAberrationFacts curves;  // finite, from the axis to the rim
};

// The curves of a lens as it is chosen; of one without any three flat ones. Errors: those of lens_facts().
Result<BentLens> bent_lens_of(const LensChoice& choice);

// Moves the focus of the zones around one (0…1 of the pupil's radius), of every wavelength or of that nearest
// to `only_nm`, + away from the lens; less and less towards zones a quarter of the radius away.
void bend(BentLens& lens, double zone, double by_mm, double only_nm = 0);

// Text of a curve lens file (docs/reference/lens-files.md).
std::string lens_file_text(const BentLens& lens);

}  // namespace petzval::view
