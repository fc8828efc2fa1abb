// The first look at a frame: of no more pixels than can be drawn at once.
#pragma once

#include "maker.h"

namespace petzval::view {

// Distance of the pixels and rows that a first draft uses.
int thinning_of(const Wish& wish);

// The look for Session::defocus(), which would name light among what it leaves out.
inline Look of_blur_alone(Look look) {
    look.vignetting = false;
    look.expand_highlights = false;
    look.glare = {};
    return look;
}

// The frame on a sensor of fewer pixels, enlarged to its own; its codes, where control wants them, as they
// are.
Result<DefocusReport> first_look(Session& session, const Rendered& rendered, Look look, int by,
                                 const Control& control);

}  // namespace petzval::view
