// The flags that choose a look: one row each. Reading, help, and the words in which messages speak of fields
// all go by this table.
#pragma once

#include "petzval/look.h"
#include "petzval/result.h"

#include <functional>
#include <string>
#include <vector>

namespace petzval::cli {

struct LookRow {
    const char* heading;      // of the help, under which it stands
    const char* flag;         // "--blades"
    const char* field;        // "lens.blades", see petzval/look_json.h
    std::string placeholder;  // empty: a switch, which takes no value
    const char* help;
    // The text of a flag as JSON. Errors complete "--blades five: …".
    std::function<Result<std::string>(const std::string&)> to_json;
};

const std::vector<LookRow>& look_rows();

// The other way: what is typed for that JSON, so that row.to_json() of it says the same. "" for null.
std::string typed_text(const std::string& json);

}  // namespace petzval::cli
