// Values of a look as JSON, by their type. Reading fails with a message that completes "lens.blades: …".
#pragma once

#include "petzval/lens_choice.h"
#include "petzval/names.h"
#include "petzval/result.h"

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace petzval::look {

using Json = nlohmann::ordered_json;
using Range = std::pair<double, double>;  // 0, 0 is none

Json to_json(double value);  // infinity is "inf"
Json to_json(int value);
Json to_json(bool value);
Json to_json(std::uint64_t value);
Json to_json(const std::string& value);
Json to_json(const Range& value);  // null for none
Json to_json(const std::vector<BarrelRim>& rims);
Json to_json(const BarnDoors& doors);
template <typename E>
requires std::is_enum_v<E> Json to_json(E value) { return name_of(value); }
template <typename T>
Json to_json(const std::optional<T>& value) {
    return value ? to_json(*value) : Json(nullptr);
}

Status from_json(const Json& json, double& value);
Status from_json(const Json& json, int& value);
Status from_json(const Json& json, bool& value);
Status from_json(const Json& json, std::uint64_t& value);
Status from_json(const Json& json, std::string& value);
Status from_json(const Json& json, Range& value);
Status from_json(const Json& json, std::vector<BarrelRim>& rims);
Status from_json(const Json& json, BarnDoors& doors);

// The value for messages: ASCII on one line, cut if it is long.
std::string shown(const Json& json);
// "must be a whole number, not "five""
Error must_be(const std::string& what, const Json& json);

template <typename E>
requires std::is_enum_v<E> Status from_json(const Json& json, E& value) {
    if (!json.is_string()) return must_be("a name", json);
    const Result<E> read = parse<E>(json.get<std::string>());
    if (!read) return Error{ErrorCode::InvalidFile, shown(json) + " is " + read.error().message};
    value = *read;
    return Done{};
}
template <typename T>
Status from_json(const Json& json, std::optional<T>& value) {
    if (json.is_null()) {
        value.reset();
        return Done{};
    }
    T read{};
    Status done = from_json(json, read);
    if (done) value = std::move(read);
    return done;
}

}  // namespace petzval::look
