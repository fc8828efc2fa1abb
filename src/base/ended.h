// The early end of a frame, alike in every room.
//
// A foreseeable failure (arguments, files, too little memory) is returned as a Result or a Status. A failure
// in the middle of work is thrown as an Ended, by a device that fails (device/failure.h) or by a host's
// cancellation (base/cancel.h). Engines and devices let it pass; the session's door catches it, and a host
// sees the error. Nothing else is thrown but std::bad_alloc.
#pragma once

#include "petzval/result.h"

#include <utility>

namespace petzval {

struct Ended {
    explicit Ended(Error why) : error(std::move(why)) {}
    Error error;
};

}  // namespace petzval
