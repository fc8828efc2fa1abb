// Every field of a look that is written: its path, and how it goes to JSON and back. One table, which
// reading, writing and the search for choices without effect walk.
#pragma once

#include "petzval/look.h"
#include "petzval/result.h"

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace petzval::look {

using Json = nlohmann::ordered_json;

struct Field {
    std::string path;  // "lens.blades"
    std::function<Json(const Look&)> get;
    // Errors: a message that completes "lens.blades: …".
    std::function<Status(Look&, const Json&)> set;
};

const std::vector<Field>& fields();
// Null if there is none of that path.
const Field* find_field(const std::string& path);

}  // namespace petzval::look
