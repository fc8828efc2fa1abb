#pragma once

#include "petzval/image.h"

#include <functional>

namespace petzval::engine {

// Light of pixel (x, y) without what a lamp adds to it (engine/lights: HighlightSplit::dim).
using Dim = std::function<Rgba(int x, int y, Rgba light)>;

}  // namespace petzval::engine
