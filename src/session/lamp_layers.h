// Layers of light that name a lamp.
#pragma once

#include "petzval/result.h"

#include "session/blurred.h"
#include "session/request.h"

#include <functional>

namespace petzval {

using MakeFrame = std::function<Result<Blurred>(const FrameRequest&)>;

// True if layers name a lamp other than the lens's own light.
bool has_lamps(const FrameRequest& request);

// The frame that `make` makes, in which layers with a spectrum are blurred as that lamp's light, in the
// picture too. Each lamp costs another frame, by the same picture and so by the same weights; what it changes
// of its layers is added to the picture. Errors: those of `make`; InvalidArgument for a layer that is not
// light, and with engine gaussian. Requires: the lens is open.
Result<Blurred> with_lamps(const FrameRequest& request, const MakeFrame& make);

// Errors: InvalidArgument where a lamp of the layers would change nothing with this look.
Status check_lamps(const FrameRequest& request);

}  // namespace petzval
