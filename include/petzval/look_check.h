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
    // Choices that change no picture beside the others, as blades with an engine whose blur is always round.
    // One sentence each that begins with its field; in the order of the JSON.
    std::vector<Error> idle = {};
};

// What differs from the defaults counts as chosen, and so does what was `said`: paths of fields, as
// lens.blades, that somebody wrote out at whatever value. Only what the look itself tells is looked at: that
// a lens traced from its surfaces takes no coma is said by Lens::open(), that radii leave nothing to focus by
// whoever has the picture.
PETZVAL_API LookCheck check(const Look& look, const std::vector<std::string>& said = {});

}  // namespace petzval
