// Writes a look to a file. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/look_json.h"
#include "petzval/result.h"

#include <string>

namespace petzval {

// read_look() reads it. Errors: OutputFailed, also if the file exists and must not be overwritten.
PETZVAL_API Status write_look(const Look& look, const std::string& path, bool overwrite = true);

}  // namespace petzval
