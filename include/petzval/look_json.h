// A look as text, to keep, to send and to compare: JSON, one key a field, in sections.
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

// A named look that ships.
struct LookPreset {
    std::string name, purpose;
    Look look;
};
PETZVAL_API const std::vector<LookPreset>& look_presets();
// Errors: InvalidArgument that lists the presets.
PETZVAL_API Result<Look> look_preset(const std::string& name);

// The other way: keys that are left out keep their defaults. look_from_json(look_to_json(look)) is `look`,
// bit for bit, but for pictures and views. Errors: InvalidFile for text that is no JSON, is no look or comes
// from a later version, for an unknown key (with the known one that it resembles), a key given twice, a value
// of the wrong type; the message names the key by its path, as lens.blades. Whether values fit each other is
// said by check(). The key "preset" names a preset whose fields stand where others are left out. The text may
// also be a link of the lens lab, the URL or its fragment; then the look has the lens of the link. A number
// that its flag would refuse is refused here too.
PETZVAL_API Result<Look> look_from_json(const std::string& text);

// The look with one field changed: its path as in the JSON ("engine", "lens.blades"), its value as JSON,
// where a name or a file needs no quotes. Errors: InvalidArgument for an unknown path or a value of the wrong
// type.
PETZVAL_API Result<Look> look_with(Look look, const std::string& path, const std::string& value);

}  // namespace petzval
