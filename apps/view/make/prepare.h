// The facts that the window has before it opens, from the settings of the command line.
#pragma once

#include "view.h"

namespace petzval::view {

// Fills everything of a setup that run() fills, except the OpenGL context. Errors: InvalidFile if no frame of
// the shot exists; those of the lens, if --fstop open asks for its widest aperture.
Status prepare(Setup& setup);

}  // namespace petzval::view
