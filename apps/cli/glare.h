// Glare and falloff of a command: what `defocus` does after the blur and `develop` before the tone curve.
#pragma once

#include "petzval/glare.h"
#include "petzval/look.h"
#include "petzval/result.h"
#include "petzval/shot.h"

namespace petzval::cli {

// Changes shot.colour; nothing if the look has none. Camera numbers that are missing are an error only where
// a part needs them. Errors: those of add_falloff and add_glare.
Status add_light(Shot& shot, const Look& look, const Lens& lens, int threads);

}  // namespace petzval::cli
