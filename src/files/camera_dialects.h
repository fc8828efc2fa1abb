// Camera numbers from a file's metadata: who writes which name in which unit.
#pragma once

#include "petzval/files.h"

#include <string>
#include <vector>

namespace petzval {

// A header attribute as numbers: float, int, rational, vectors, and text that holds one number.
struct NumericAttribute {
    std::string name;
    std::vector<double> values;
};

// The first row of the dialect table that fits wins, for each number on its own; focal length or sensor width
// that is missing follows from the field of view where the other one is known.
FoundCamera camera_from_metadata(const std::vector<NumericAttribute>& attributes);

// A number that text holds, with or without "mm" behind it; nothing if there is anything else.
std::vector<double> numbers_in_text(const std::string& text);

}  // namespace petzval
