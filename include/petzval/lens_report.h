// The sheet of a lens: everything it does to light, as one HTML page that needs nothing else; and the sheets
// that show many lenses side by side. Part of petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <string>
#include <vector>

namespace petzval {

// A page with its figures inside (SVG, PNG as data: URIs, CSS; no scripts), XHTML so that any XML reader
// takes it; the same bytes every time. Errors: those of lens_facts() and of mounting the lens at its own
// aperture. Drawn by the workers `lent` by a host, or by our own `threads` (0: all).
PETZVAL_API Result<std::string> lens_report(const std::string& name_or_file, int threads = 0,
                                            Workers* lent = nullptr);

// Entry of a lens on sheets of many lenses.
struct LensCard {
    std::string name, title, year, kind;
    std::string focal_length, f_number, blur;  // with units, as shown
    std::string discs;                         // SVG: a disc in front of focus and one behind
    std::string curve;                         // SVG: longitudinal aberration
    std::string rays;                          // SVG: rays near the focus
    std::string texture;                       // SVG: the bokeh texture
};
PETZVAL_API Result<LensCard> lens_card(const std::string& name_or_file, int threads = 0,
                                       Workers* lent = nullptr);

// HTML pages that link to NAME.html for each card: the contact sheet; and one row per lens with its curve,
// rays, texture, discs and numbers.
PETZVAL_API std::string lens_index(const std::vector<LensCard>& cards);
PETZVAL_API std::string lens_comparison(const std::vector<LensCard>& cards);
// The contact sheet as a separate SVG file.
PETZVAL_API std::string lens_contact_sheet(const std::vector<LensCard>& cards);

}  // namespace petzval
