// The failure of a frame whose device cannot continue.
#pragma once

#include "petzval/result.h"

namespace petzval::device {

// Thrown by a device through our own code, caught at the session's door (as Cancelled is); never seen by a
// host.
struct Failed {
    Error error;
};

}  // namespace petzval::device
