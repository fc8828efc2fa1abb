// A look kept in a file. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/look_json.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

// Files that a look names (a lens, pictures of an aperture or of a disc) stand in its text as they are seen
// from the folder of the look, so that both can be moved together; in a Look they are as seen from the
// current folder. A lens is a file where its name has a slash in it, or an extension and is there.

// Errors: InvalidFile with the path: no regular file, more than a megabyte, or what look_from_json() refuses.
// `path` may also be a link of the lens lab. Errors of a link: InvalidFile.
PETZVAL_API Result<Look> read_look(const std::string& path);
// Errors: OutputFailed, also where the file exists and is not to be overwritten.
PETZVAL_API Status write_look(const Look& look, const std::string& path, bool overwrite = true);

// The folder of a user's own presets, NAME.json: $PETZVAL_PRESETS, otherwise petzval/presets in
// $XDG_CONFIG_HOME or ~/.config; empty where none of them is set.
PETZVAL_API std::string preset_folder();
// A preset of that folder, otherwise one that ships. Errors: those of read_look() and look_preset().
PETZVAL_API Result<Look> read_preset(const std::string& name);
// All of them, a user's own first; broken files are left out.
PETZVAL_API std::vector<LookPreset> all_presets();

}  // namespace petzval
