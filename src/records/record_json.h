// Records while they grow. Keys stay in the order in which they are set.
#pragma once

#include "petzval/records.h"

#include <nlohmann/json.hpp>

namespace petzval::records {

using Json = nlohmann::ordered_json;

// File names need not be UTF-8: what is not becomes U+FFFD.
inline std::string as_text(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

inline Json number(double value) { return Json::parse(record_of_number(value)); }

// Seconds of each stage, and their sums: those with a separate name, and `compute`, out of `seconds`.
void add_stages(Json& record, const std::vector<StageTime>& stages, double seconds);

}  // namespace petzval::records
