// A frame's report as JSON.
#pragma once

#include "petzval/defocus.h"

#include <string>

namespace petzval::c {

std::string report_text(const DefocusReport& report);

}  // namespace petzval::c
