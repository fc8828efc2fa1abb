#include "plate.h"

#include "values.h"

#include <utility>

namespace petzval::cli {

std::string in_words(const HighlightExpansion& e) {
    return "blurred as if light above " + plain(e.knee) + " rose to " + plain(e.peak) +
           " at 1 (assumed); pixels are in the plate's own range";
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
