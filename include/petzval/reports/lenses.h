// Records of the facts of lenses. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/lens_facts.h"

#include <string>
#include <vector>

namespace petzval {

// The records of `petzval lens list --json`, `lens show --json` and `lens check --json`. `input`: the lens as
// requested; `seconds`: the time its facts took. Facts of a lens without surfaces have nothing to check.
PETZVAL_API std::string lens_list_record(const std::vector<LensSummary>& lenses);
PETZVAL_API std::string lens_show_record(const LensFacts& facts, const std::string& input, double seconds);
PETZVAL_API std::string lens_check_record(const LensFacts& facts, const std::string& input, double seconds);

}  // namespace petzval
