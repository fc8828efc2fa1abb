// The library's messages name fields, as camera.f_number; a user knows flags, as --fstop.
#pragma once

#include "petzval/result.h"

#include <functional>
#include <string>
#include <vector>

namespace petzval::cli {

// The text with every field that has a flag spoken of by that flag.
std::string in_flags(const std::string& text);
std::vector<std::string> in_flags(std::vector<std::string> lines);
// Later messages use these words instead of the flag if the flag was not typed; a non-empty `ending` ends
// such a message.
void say_in_place_of(const std::string& flag, const std::string& words,
                     std::function<std::string(const std::string&)> ending);
// The message of an error that begins with its field, as messages on looks do.
std::string spoken(const Error& error);

}  // namespace petzval::cli
