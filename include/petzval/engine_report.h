// Report of an engine's run, besides the picture.
#pragma once

#include "petzval/image.h"

#include <cstdint>
#include <optional>
#include <string>

namespace petzval {

struct StageTime {
    std::string stage;
    double seconds = 0;
    // Bytes touched and multiply-adds, as the stage counted them (docs/reference/report.md); 0: it did not.
    std::uint64_t bytes = 0, multiply_adds = 0;
};

// One of several pictures in one.
struct Panel {
    std::string name;
    Rect area;
    Rgba colour;                            // that stands for it in a map among the panels; all 0: none
    std::optional<std::string> layer = {};  // of a file, that can hold it: it is of the input's size
    bool is_numbers = false;                // red holds a number for every pixel, NaN for none; not light
};

}  // namespace petzval
