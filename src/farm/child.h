// Runs other programs and returns the text that they print.
#pragma once

#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval::farm {

// Runs a program found in $PATH, without a shell, and waits for its end. Returns its standard output; its
// standard error is this program's. Errors: Unsupported if $PATH holds no program of that name; OutputFailed
// if it does not end with 0.
Result<std::string> output_of(const std::vector<std::string>& words);

}  // namespace petzval::farm
