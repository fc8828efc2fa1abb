// Links of the lens lab (docs/reference/lens-lab.md): a choice in the fragment of a URL,
// "lens=VERSION.BASE64URL" of JSON {"lens": {"name", "text", "look": {…}}, "camera": {…}, "light": {…}}.
#pragma once

#include "petzval/look.h"
#include "petzval/result.h"

#include <string>

namespace petzval::look {

// True for text that is meant as a link, damaged or not.
bool is_link(const std::string& text);
// The lens of a link: its name and its fields. Camera and light are of the lab's disc and of no look. Errors:
// InvalidFile for a damaged link, one from a later version, and one that holds a pasted lens, which no look
// can.
Result<Look> look_from_link(const std::string& text);

}  // namespace petzval::look
