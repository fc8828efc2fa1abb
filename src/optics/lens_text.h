// Names of lenses that are the content of a lens file themselves, as looks and links of the lens lab hold
// them.
#pragma once

#include <string>

namespace petzval::optics {

// True if the name of a lens (LensChoice::name) is the content of a lens file: several lines, or JSON.
inline bool is_lens_text(const std::string& name) {
    return name.find('\n') != std::string::npos || name.starts_with('{');
}

// Stands for such a lens in messages, reports and Lens::name().
inline constexpr const char* kLensOfText = "pasted";

}  // namespace petzval::optics
