// Ends and units of the sliders of look fields. Ctrl-click types a number beyond the ends.
#pragma once

#include "widgets.h"

#include <optional>
#include <string>

namespace petzval::view {

// Nothing: the field has no usual range.
std::optional<Ends> usual_ends(const FieldRow& row);
// printf() format of a number with the unit of its placeholder: "%.5g mm".
std::string number_format(const std::string& placeholder, bool is_whole);

}  // namespace petzval::view
