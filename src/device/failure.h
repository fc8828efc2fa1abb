// The failure of a frame whose device cannot continue.
#pragma once

#include "base/ended.h"

namespace petzval::device {

// Nothing is then added to the result of the verb that threw it.
struct Failed : Ended {
    using Ended::Ended;
};

}  // namespace petzval::device
