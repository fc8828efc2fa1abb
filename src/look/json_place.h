// The place in a text at which it stops being JSON.
#pragma once

#include <string>

namespace petzval::look {

// "line 4, column 7". Requires: the text is not JSON.
std::string place_of_error(const std::string& text);

}  // namespace petzval::look
