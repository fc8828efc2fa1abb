// Numbers that a field of a look may have, the same for files, flags, tracks and hosts.
#pragma once

#include "petzval/result.h"

#include "look/fields.h"

#include <string>

namespace petzval::look {

// Errors: a message that completes "glare.bloom: …". True of values that are not a number, which the field's
// own reader judges.
Status check_limit(const std::string& path, const Json& value);

}  // namespace petzval::look
