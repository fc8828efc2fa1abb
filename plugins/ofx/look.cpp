#include "look.h"

#include "petzval/petzval_lens_c.h"

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace petzval::plugin {
namespace {

using Json = nlohmann::json;

Error refused(std::string why) { return {ErrorCode::InvalidArgument, std::move(why)}; }
Error last_error() { return refused(petzval_error_text()); }

Result<LookHandle> from_json(const std::string& json) {
    petzval_look* look = nullptr;
    if (petzval_look_from_json(json.c_str(), &look) != PETZVAL_OK)
        return refused(std::string("Look: ") + petzval_error_text());
    return LookHandle(look);
}

Result<LookHandle> from_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{ErrorCode::InvalidFile, "Look: cannot read " + path};
    return from_json({std::istreambuf_iterator<char>(file), {}});
}

// Empty for text that is not base64url (RFC 4648, section 5), which needs no padding.
std::string decoded(std::string_view text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const auto digit = kDigits.find(c);
        if (digit == std::string_view::npos) return "";
        bits = bits << 6 | unsigned(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += char(bits >> count & 0xff);
    }
    return bytes;
}

constexpr std::string_view kLinkMark = "lens=1.";  // and JSON as the lens lab writes it (web/lab/state.js)

Result<LookHandle> from_link(std::string_view fragment) {
    const Json told = Json::parse(decoded(fragment), nullptr, false);
    if (!told.is_object() || !told.contains("lens") || !told["lens"].is_object())
        return refused("Look: the link is cut off or from elsewhere");
    const Json& lens = told["lens"];
    Json fields = lens.value("look", Json::object());
    const bool has_text = lens.contains("text") && lens["text"].is_string();
    if (!has_text && lens.contains("name")) fields["name"] = lens["name"];
    auto look = from_json(Json{{"petzval_look", 1}, {"lens", fields}}.dump());
    if (!look || !has_text) return look;
    const std::string text = lens["text"];
    petzval_lens* own = nullptr;
    if (petzval_lens_from_memory(text.data(), text.size(), "the lens of the link", &own) != PETZVAL_OK)
        return last_error();
    const bool taken = petzval_look_set_lens(look->get(), own) == PETZVAL_OK;
    petzval_lens_close(own);
    if (!taken) return last_error();
    return look;
}

Result<LookHandle> named_look(const std::string& text) {
    const auto begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return from_json(R"({"petzval_look": 1})");
    const std::string trimmed = text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
    if (trimmed[0] == '{') return from_json(trimmed);
    const auto mark = trimmed.find(kLinkMark);
    if (mark != std::string::npos)
        return from_link(std::string_view(trimmed).substr(mark + kLinkMark.size()));
    return from_file(trimmed);
}

}  // namespace

Result<LookHandle> look_of(const Values& values, bool draft) try {
    auto look = named_look(values.look);
    if (!look) return look;
    const auto choose = [&](const char* field, const std::string& value) {
        return value.empty() ||
               petzval_look_set(look->get(), field, Json(value).dump().c_str()) == PETZVAL_OK;
    };
    if (!choose("lens.name", values.lens) || !choose("engine", values.engine) ||
        !choose("quality", draft ? "draft" : values.quality))
        return last_error();
    return look;
} catch (const Json::exception& wrong) {  // text that is not UTF-8, members of another type
    return refused(std::string("Look: ") + wrong.what());
}

}  // namespace petzval::plugin
