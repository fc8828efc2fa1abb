// The pixels that touch a silhouette.
#pragma once

#include "petzval/workers.h"

#include "engine/samples/hidden.h"

namespace petzval::engine {

// Bits of a pixel: it touches a silhouette, and lamps light it or one beside it.
enum Touching : unsigned char { kTouches = 1, kLit = 2 };

// The bits of each pixel. connected: of engine/samples/silhouettes/connectivity.h.
Image<unsigned char> touching_silhouettes(const LitPicture& picture, View<const unsigned char> connected,
                                          Workers& workers);

}  // namespace petzval::engine
