// A look kept in a file. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/result.h"

#include <string>

namespace petzval {

// Files that a look names (a lens, pictures of an aperture or of a disc) stand in its text as they are seen
// from the folder of the look, so that both can be moved together; in a Look they are as seen from the
// current folder. A lens is a file where its name has a slash in it, or an extension and is there.

// Errors: InvalidFile with the path: no regular file, more than a megabyte, or what look_from_json() refuses.
PETZVAL_API Result<Look> read_look(const std::string& path);
// Errors: OutputFailed, also where the file exists and is not to be overwritten.
PETZVAL_API Status write_look(const Look& look, const std::string& path, bool overwrite = true);

}  // namespace petzval
