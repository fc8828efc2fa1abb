// A check in a separate process, which a plug-in may end or block.
#pragma once

#include "checks.h"
#include "rules.h"

namespace ofx_check {

void run_check(const Check& check, const Setup& setup, double timeout_s, Outcomes& outcomes);

}  // namespace ofx_check
