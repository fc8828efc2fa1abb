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
    // Bytes and multiply-adds as counted by the stage (docs/reference/report.md); 0: not counted.
    std::uint64_t bytes = 0, multiply_adds = 0;
    bool is_glare = false;  // falloff or glare, after the engine
};

// One of several pictures in one.
struct Panel {
    std::string name;
    Rect area;
    Rgba colour;                            // its colour in a map among the panels; all 0: none
    std::optional<std::string> layer = {};  // layer of a file that can store it, if it has the input's size
    bool is_numbers = false;                // red holds a number for every pixel, NaN for none; not light
};

}  // namespace petzval
