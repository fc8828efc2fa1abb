// The lenses that ship with the library. They are compiled in from lenses/*.json, so a program finds them
// wherever it is installed.
#pragma once

#include "petzval/result.h"

#include "lens_files/lens_file.h"

#include <span>
#include <string>
#include <string_view>

namespace petzval::lens_files {

struct ShelfItem {
    std::string_view name;  // the file's name without .json
    std::string_view text;  // its content
};
// The shelf in alphabetical order of names.
std::span<const ShelfItem> shelf();

// The content of lenses/glasses.json.
std::string_view glasses_text();

// A lens of the shelf by name, else the file of that path, else a lens of the shelf by the id that it has in
// its source or by one of its "names", whatever their case, blanks and hyphens.
// Errors: InvalidArgument when it is neither (the message lists the shelf); those of load_lens_file.
Result<LensFile> find_lens(const std::string& name_or_path);

}  // namespace petzval::lens_files
