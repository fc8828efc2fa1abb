#include "look/look_link.h"

#include "petzval/look_json.h"

#include "look/fields.h"
#include "look/limits.h"
#include "optics/lens_text.h"

#include <optional>

namespace petzval::look {
namespace {

constexpr int kLinkVersion = 1;
constexpr std::size_t kMostBytes = std::size_t(1) << 20;
const std::string kMark = "lens=";

// One line: a key of the link may hold control characters.
Error refused(std::string why) {
    for (char& c : why)
        if ((c >= 0 && c < ' ') || c == 127) c = '?';
    return {ErrorCode::InvalidFile, "is a link of the lens lab, but " + why};
}

std::string without_blanks(const std::string& text) {
    const char* const blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// The fragment of a URL, without "#"; text without "#" is a fragment.
std::string fragment_of(const std::string& text) {
    const std::string link = without_blanks(text);
    const std::size_t hash = link.find('#');
    return hash == std::string::npos ? link : link.substr(hash + 1);
}

std::optional<std::string> from_base64url(const std::string& text) {
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::size_t value =
            std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_").find(c);
        if (value == std::string::npos) return std::nullopt;
        bits = bits << 6 | unsigned(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += char(bits >> count & 255u);
        bits &= (1u << count) - 1;
    }
    // A lone character, or bits that no byte took, are what is left of a link that was cut off.
    return count >= 6 || bits != 0 ? std::nullopt : std::optional(bytes);
}

Result<Look> look_of(const Json& told) {
    if (!told.is_object() || !told.contains("lens") || !told["lens"].is_object())
        return refused("it names no lens");
    const Json& lens = told["lens"];
    if (!lens.contains("name") || !lens["name"].is_string()) return refused("it names no lens");
    Look look;
    look.lens.name = lens["name"].get<std::string>();
    if (lens.contains("text") && !lens["text"].is_null()) {
        if (!lens["text"].is_string()) return refused("its lens is not text");
        look.lens.name = lens["text"].get<std::string>();
        if (!optics::is_lens_text(look.lens.name)) return refused("its lens has one line only");
    }
    const Json none = Json::object();
    const Json& fields = lens.contains("look") ? lens["look"] : none;
    if (!fields.is_object()) return refused("its choices are not an object");
    for (const auto& [name, value] : fields.items()) {
        const std::string path = "lens." + name;
        const Field* const field = find_field(path);
        if (!field || name == "name") return refused("this program does not know its field " + path);
        if (const Status fits = check_limit(path, value); !fits)
            return refused(path + " " + fits.error().message);
        if (const Status done = field->set(look, value); !done)
            return refused(path + " " + done.error().message);
    }
    return look;
}

}  // namespace

bool is_link(const std::string& text) {
    const std::string link = without_blanks(text);
    if (link.empty() || link[0] == '{' || link.find('\n') != std::string::npos) return false;
    return fragment_of(link).starts_with(kMark);
}

Result<Look> look_from_link(const std::string& text) {
    const std::string fragment = fragment_of(text);
    if (fragment.size() > kMostBytes) return refused("it is longer than a megabyte");
    const std::size_t dot = fragment.find('.');
    const std::string version =
        dot == std::string::npos ? "" : fragment.substr(kMark.size(), dot - kMark.size());
    if (version.empty() || version.find_first_not_of("0123456789") != std::string::npos)
        return refused("it is cut off: after \"lens=\" come a version, a dot and the choice");
    if (version.size() > 6 || std::stoi(version) > kLinkVersion)
        return refused("it comes from a later version (" + version.substr(0, 12) + "), this one reads " +
                       std::to_string(kLinkVersion));
    const auto json = from_base64url(fragment.substr(dot + 1));
    const Json told = json ? Json::parse(*json, nullptr, false) : Json(Json::value_t::discarded);
    if (told.is_discarded()) return refused("it is cut off or damaged");
    return look_of(told);
}

}  // namespace petzval::look
