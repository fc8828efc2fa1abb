#include "look.h"

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace petzval::plugin {
namespace {

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

Result<LookHandle> named_look(const std::string& text) {
    const auto begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string::npos) return from_json(R"({"petzval_look": 1})");
    const std::string trimmed = text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
    // A link of the lens lab is its URL, or the fragment of that.
    const bool is_link = trimmed.starts_with("lens=") || trimmed.find("#lens=") != std::string::npos;
    return trimmed[0] == '{' || is_link ? from_json(trimmed) : from_file(trimmed);
}

Result<LookHandle> preset_look(const Values& values) {
    if (!values.look.empty()) return refused("Preset and Look are both given; clear one of them");
    petzval_look* look = nullptr;
    if (petzval_look_from_preset(values.preset.c_str(), &look) != PETZVAL_OK)
        return refused(std::string("Preset: ") + petzval_error_text());
    return LookHandle(look);
}

}  // namespace

Result<LookHandle> look_of(const Values& values, bool draft) {
    auto look = values.preset.empty() ? named_look(values.look) : preset_look(values);
    if (!look) return look;
    const auto choose = [&](const char* field, const std::string& value) {
        return value.empty() || petzval_look_set(look->get(), field, value.c_str()) == PETZVAL_OK;
    };
    if (!choose("lens.name", values.lens) || !choose("engine", values.engine) ||
        !choose("quality", draft ? "draft" : values.quality))
        return last_error();
    return look;
}

}  // namespace petzval::plugin
