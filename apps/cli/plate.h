// A plate of low range, given its highlights back for the blur alone.
#pragma once

#include "petzval/dynamic_range.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include "flags.h"
#include "report.h"

#include <optional>
#include <string>

namespace petzval::cli {

struct PlateFlags {
    bool expand = false;
    std::optional<double> peak;

    void add_to(Verb& verb);
    void check() const;  // throws UsageError for a peak without --expand-highlights
    HighlightExpansion expansion() const;
    // The assumption in words, for logs and the attribute petzval:expandHighlights.
    std::string in_words() const;
    Json json() const;  // null without --expand-highlights
};

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
