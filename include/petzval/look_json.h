// A look as text that can be stored, sent and compared: JSON in sections, one key per field. Presets are
// looks with names.
#pragma once

#include "petzval/export.h"
#include "petzval/look.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

// The form that look_to_json writes, under the key "petzval_look".
constexpr int kLookVersion = 1;

// Every field, also those at their defaults, so that the text means the same where defaults have changed.
// Indented, ends with a newline. Infinity is the word "inf".
PETZVAL_API std::string look_to_json(const Look& look);

// A built-in look with a name.
struct LookPreset {
    std::string name, purpose;
    Look look;
};
PETZVAL_API const std::vector<LookPreset>& look_presets();
// Errors: InvalidArgument that lists the presets.
PETZVAL_API Result<Look> look_preset(const std::string& name);

// Reads a look from JSON, or from a link of the lens lab (the URL or its fragment, which includes the lens).
//
// Missing keys keep their defaults; the key "preset" names a preset whose fields replace those defaults.
// look_from_json(look_to_json(look)) equals `look` bit for bit, except for pictures and views. Errors:
// InvalidFile if the text is not JSON, is not a look or comes from a later version; if a key is unknown
// (the message suggests the known key that resembles it) or given twice; if a value has the wrong type or
// its flag would refuse it. The message names the key by its path, such as lens.blades. check() reports
// whether values fit each other.
PETZVAL_API Result<Look> look_from_json(const std::string& text);

// The look with one field changed: its path as in the JSON ("engine", "lens.blades"), its value as JSON,
// where a name or a file needs no quotes. Errors: InvalidArgument for an unknown path or a value of the wrong
// type.
PETZVAL_API Result<Look> look_with(Look look, const std::string& path, const std::string& value);

// Paths in a look's text (a lens, pictures of an aperture or of a disc) are relative to the folder of the
// look, so that both can be moved together; in a Look they are relative to the current folder. The name of
// a lens is a path if it contains a slash, or has an extension and the file exists.

// Errors: InvalidFile with the path: no regular file, more than a megabyte, or what look_from_json() refuses.
// `path` may also be a link of the lens lab. Errors of a link: InvalidFile.
PETZVAL_API Result<Look> read_look(const std::string& path);
// The text of a look file for `folder`.
PETZVAL_API std::string look_to_json_in(const Look& look, const std::string& folder);

// The folder of a user's own presets, NAME.json: $PETZVAL_PRESETS, otherwise petzval/presets in
// $XDG_CONFIG_HOME or ~/.config; empty if none of them is set.
PETZVAL_API std::string preset_folder();
// A preset of that folder, otherwise a built-in one. Errors: those of read_look(); InvalidArgument that
// lists all presets.
PETZVAL_API Result<Look> read_preset(const std::string& name);
// All presets, the user's own first; broken files are skipped.
PETZVAL_API std::vector<LookPreset> all_presets();

}  // namespace petzval
