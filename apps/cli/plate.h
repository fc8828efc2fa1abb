// A plate of low range, given its highlights back for the blur alone.
#pragma once

#include "petzval/dynamic_range.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include <string>

namespace petzval::cli {

// The assumption in words, for logs and the attribute petzval:expandHighlights.
std::string in_words(const HighlightExpansion& expansion);

// The plate while its picture is being blurred.
class ExpandedPlate {
public:
    // Keeps the plate and puts its expanded light in its place. Errors: those of expand_highlights.
    static Result<ExpandedPlate> take(Picture& colour, const HighlightExpansion& expansion);
    // The blurred picture in the plate's own range.
    Picture back(const Picture& blurred) const;

private:
    Picture plate_, expanded_;
    HighlightExpansion expansion_;
};

}  // namespace petzval::cli
