// Published values that travel with a lens ("expected" in its JSON), against what we compute: the validation
// table.
#pragma once

#include "petzval/result.h"

#include "lens_files/json.h"
#include "optics/prescription.h"

#include <string>
#include <vector>

namespace petzval::lens_files {

// One number. A value of several numbers makes several checks: "S_III, surface 2", "ray 4, y".
struct ExpectedCheck {
    std::string quantity, source;
    double published = 0, ours = 0;
    double allowed = 0;      // largest |ours - published| that counts as reproduced
    bool one_sided = false;  // published is a lower bound
    bool comparable = true;  // false: listed for information, nothing published defines it closely enough

    double difference() const { return ours - published; }
    bool passed() const;
};

// The fault of a lens whose f-number differs from the stated one: its clear apertures cut the light of the
// middle of the field first. Empty: no fault, or the lens could not be traced.
std::string f_number_problem(const optics::Prescription& lens);

// Allowed is the entry's "tolerance"; else |its "difference"| + half the last printed digit; 5e-6 for Seidel
// sums of single surfaces; never below 1e-12 of the value, which is as far as double precision carries
// through a lens. Errors: InvalidFile "line N: …" for a quantity that is not known or has another form.
Result<std::vector<ExpectedCheck>> check_expected(const Json& lens_entry, const optics::Prescription& lens);

}  // namespace petzval::lens_files
