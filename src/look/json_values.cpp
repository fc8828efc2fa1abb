#include "look/json_values.h"

#include <cmath>
#include <limits>

namespace petzval::look {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The numbers of a list of so many, or nothing.
std::optional<std::vector<double>> numbers(const Json& json, std::size_t count) {
    if (!json.is_array() || json.size() != count) return std::nullopt;
    std::vector<double> all(count);
    for (std::size_t i = 0; i < count; ++i)
        if (!from_json(json[i], all[i])) return std::nullopt;
    return all;
}

}  // namespace

// Long values are cut: they are read by a person. What may be nested without end is not written out.
std::string shown(const Json& json) {
    if (json.is_object()) return "an object";
    if (json.is_array()) return "this list";
    constexpr std::size_t kMost = 60;
    const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() > kMost ? text.substr(0, kMost) + "…" : text;
}

Error must_be(const std::string& what, const Json& json) {
    return {ErrorCode::InvalidFile, "must be " + what + ", not " + shown(json)};
}

Json to_json(double value) {
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    return value;
}
Json to_json(int value) { return value; }
Json to_json(bool value) { return value; }
Json to_json(std::uint64_t value) { return value; }
Json to_json(const std::string& value) { return value; }
Json to_json(const Range& value) {
    return value == Range{} ? Json(nullptr) : Json::array({to_json(value.first), to_json(value.second)});
}
Json to_json(const std::vector<BarrelRim>& rims) {
    Json all = Json::array();
    for (const BarrelRim& rim : rims)
        all.push_back({{"radius_mm", to_json(rim.radius_mm)}, {"distance_mm", to_json(rim.distance_mm)}});
    return all;
}
Json to_json(const BarnDoors& doors) {
    return Json::array(
        {to_json(doors.left), to_json(doors.right), to_json(doors.top), to_json(doors.bottom)});
}

Status from_json(const Json& json, double& value) {
    if (json == "inf" || json == "-inf") {
        value = json == "inf" ? kInfinity : -kInfinity;
        return Done{};
    }
    if (!json.is_number()) return must_be("a number", json);
    value = json.get<double>();
    return Done{};
}
Status from_json(const Json& json, int& value) {
    const bool fits = json.is_number_unsigned()
                          ? json.get<std::uint64_t>() <= std::uint64_t(std::numeric_limits<int>::max())
                          : json.is_number_integer() &&
                                json.get<std::int64_t>() >= std::int64_t(std::numeric_limits<int>::min());
    if (!fits) return must_be("a whole number of 32 bits", json);
    value = json.get<int>();
    return Done{};
}
Status from_json(const Json& json, bool& value) {
    if (!json.is_boolean()) return must_be("true or false", json);
    value = json.get<bool>();
    return Done{};
}
Status from_json(const Json& json, std::uint64_t& value) {
    if (!json.is_number_unsigned()) return must_be("a whole number of 0 or more", json);
    value = json.get<std::uint64_t>();
    return Done{};
}
Status from_json(const Json& json, std::string& value) {
    if (!json.is_string()) return must_be("text", json);
    value = json.get<std::string>();
    return Done{};
}
Status from_json(const Json& json, Range& value) {
    const auto both = numbers(json, 2);
    if (!both && !json.is_null()) return must_be("a list of two numbers, or null for none", json);
    value = both ? Range{(*both)[0], (*both)[1]} : Range{};
    return Done{};
}
Status from_json(const Json& json, std::vector<BarrelRim>& rims) {
    const auto wrong =
        must_be("a list of rims as {\"radius_mm\": 14, \"distance_mm\": 20}, both of them numbers", json);
    if (!json.is_array()) return wrong;
    std::vector<BarrelRim> all;
    for (const Json& rim : json) {
        BarrelRim one;
        if (!rim.is_object() || rim.size() != 2 || !rim.contains("radius_mm") ||
            !rim.contains("distance_mm") || !from_json(rim["radius_mm"], one.radius_mm) ||
            !from_json(rim["distance_mm"], one.distance_mm))
            return wrong;
        all.push_back(one);
    }
    rims = std::move(all);
    return Done{};
}
Status from_json(const Json& json, BarnDoors& doors) {
    const auto four = numbers(json, 4);
    if (!four) return must_be("a list of four numbers: left, right, top, bottom", json);
    doors = {(*four)[0], (*four)[1], (*four)[2], (*four)[3]};
    return Done{};
}

}  // namespace petzval::look
