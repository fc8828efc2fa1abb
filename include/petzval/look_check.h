// Checks that the choices of a look fit each other.
#pragma once

#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

struct LookCheck {
    // Errors: InvalidArgument for choices that contradict each other: no frame can be made of this look.
    Status possible = Done{};
    // Choices without effect beside the others, such as blades with an engine whose blur is always round.
    // One sentence each, which begins with its field, in the order of the JSON.
    std::vector<Error> idle = {};
};

// Checks the fields of a look against each other. A field counts as chosen if it differs from its default
// or if `said` lists its path (such as lens.blades). Only the look itself is examined. Lens::open() reports
// that a lens traced from its surfaces ignores coma; the code that has the picture reports that radii
// ignore focus.
PETZVAL_API LookCheck check(const Look& look, const std::vector<std::string>& said = {});

// Paths of the fields that differ from their defaults, in the order of the JSON.
PETZVAL_API std::vector<std::string> chosen_fields(const Look& look);
// True for the path of a field that shows only away from the middle of the picture, such as lens.coma.
PETZVAL_API bool is_off_axis(const std::string& field);

// LookCheck::idle of a look from a file, one line for all fields that have no effect for the same reason:
// "FILE: lens.blades and lens.wave have no effect with engine gaussian". `file` begins each line.
PETZVAL_API std::vector<std::string> idle_lines(const std::string& file, const std::vector<Error>& idle);

}  // namespace petzval
