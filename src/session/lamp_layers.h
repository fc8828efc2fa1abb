// Layers of light that name a lamp.
#pragma once

#include "petzval/defocus.h"
#include "petzval/look.h"
#include "petzval/result.h"

#include <functional>

namespace petzval {

using MakeFrame = std::function<Result<DefocusReport>(const DefocusJob&)>;

// The frame that `make` makes, in which layers with a spectrum are blurred as that lamp's light, in the
// picture too. Each lamp costs another frame, by the same picture and so by the same weights; what it changes
// of its layers is added to the picture. Errors: those of `make`; InvalidArgument for a layer that is no
// light, and of engine gaussian.
Result<DefocusReport> with_lamps(const DefocusJob& job, const MakeFrame& make);

// Errors: InvalidArgument where a lamp of the layers would change nothing with this look.
Status check_lamps(const DefocusJob& job, const Look& look);

}  // namespace petzval
