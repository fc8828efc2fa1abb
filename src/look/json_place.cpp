#include "look/json_place.h"

#include "look/fields.h"

#include <algorithm>

namespace petzval::look {
namespace {

// Takes every value, and notes how many bytes were read before the error.
struct UntilError final : nlohmann::json_sax<Json> {
    std::size_t bytes = 0;

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        bytes = position;
        return false;
    }
};

}  // namespace

std::string place_of_error(const std::string& text) {
    UntilError reading;
    Json::sax_parse(text, &reading);
    const std::size_t at = std::min(std::max<std::size_t>(reading.bytes, 1), text.size() + 1) - 1;
    const std::size_t line =
        std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n')) + 1;
    const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    const std::size_t column = before == std::string::npos ? at + 1 : at - before;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

}  // namespace petzval::look
