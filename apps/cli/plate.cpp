#include "plate.h"

#include "values.h"

#include <utility>

namespace petzval::cli {

void PlateFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Input")
        .on("--expand-highlights",
            "for plates that end at 1: blur as if their highlights were as bright as they once were, then "
            "go back; what is sharp stays as it is",
            expand)
        .value("--highlight-peak", "LIGHT", "what 1 stood for then (default 16, four stops above white)",
               parse_positive, peak);
}

void PlateFlags::check() const {
    if (peak && !expand) throw UsageError("--highlight-peak has no effect without --expand-highlights");
}

HighlightExpansion PlateFlags::expansion() const {
    HighlightExpansion expansion;
    if (peak) expansion.peak = *peak;
    return expansion;
}

std::string PlateFlags::in_words() const {
    const HighlightExpansion e = expansion();
    return "blurred as if light above " + plain(e.knee) + " rose to " + plain(e.peak) +
           " at 1 (assumed); pixels are in the plate's own range";
}

Json PlateFlags::json() const {
    if (!expand) return nullptr;
    return {{"knee", expansion().knee}, {"peak", expansion().peak}};
}

Result<ExpandedPlate> ExpandedPlate::take(Picture& colour, const HighlightExpansion& expansion) {
    auto expanded = expand_highlights(colour.view(), expansion);
    if (!expanded) return expanded.error();
    ExpandedPlate kept;
    kept.plate_ = std::move(colour);
    kept.expanded_ = std::move(*expanded);
    kept.expansion_ = expansion;
    colour = kept.expanded_.clone();
    return kept;
}

Picture ExpandedPlate::back(const Picture& blurred) const {
    return compress_highlights(blurred.view(), expanded_.view(), plate_.view(), expansion_);
}

}  // namespace petzval::cli
