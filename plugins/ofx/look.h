// The look of a frame: from the parameter Preset or Look, changed by the parameters for lens, engine and
// quality.
#pragma once

#include "petzval/petzval_c.h"
#include "petzval/result.h"

#include "params.h"

#include <memory>

namespace petzval::plugin {

struct CloseLook {
    void operator()(petzval_look* look) const { petzval_look_close(look); }
};
using LookHandle = std::unique_ptr<petzval_look, CloseLook>;

// draft: the quality is draft, whatever else is chosen. Errors: InvalidArgument, InvalidFile.
Result<LookHandle> look_of(const Values& values, bool draft);

}  // namespace petzval::plugin
