// The known word that a person may have meant.
#pragma once

#include <string>
#include <vector>

namespace petzval {

// The known word that needs the fewest single-letter edits or that the given word begins; empty if none is
// near.
std::string nearest_word(const std::string& given, const std::vector<std::string>& known);

}  // namespace petzval
