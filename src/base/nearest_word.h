// The known word that a person may have meant.
#pragma once

#include <string>
#include <vector>

namespace petzval {

// That which needs the fewest single-letter edits, or which the given word begins; empty where none is near.
std::string nearest_word(const std::string& given, const std::vector<std::string>& known);

}  // namespace petzval
