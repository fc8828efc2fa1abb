#include "lens_files/json.h"

#include "lens_files/text.h"

#include <cmath>
#include <optional>
#include <utility>

namespace petzval::lens_files {
namespace {

// Recursive descent; the first problem is kept in error_ and every function returns false from there on.
class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Result<Json> parse() {
        Json root;
        skip_space();
        if (!value(root, 0)) return *error_;
        skip_space();
        if (at_ < text_.size()) {
            fail("text follows the end of the JSON value");
            return *error_;
        }
        return root;
    }

private:
    bool fail(const std::string& what) {
        if (!error_) error_ = Error{ErrorCode::InvalidFile, "line " + std::to_string(line_) + ": " + what};
        return false;
    }

    void skip_space() {
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n') ++line_;
            if (c != ' ' && c != '\t' && c != '\r' && c != '\n') return;
        }
    }

    bool next_is(char c) const { return at_ < text_.size() && text_[at_] == c; }

    bool value(Json& out, int depth) {
        out.line = line_;
        if (depth > kDeepestJson) return fail("values nested deeper than " + std::to_string(kDeepestJson));
        if (++count_ > kMostJsonValues)
            return fail("more than " + std::to_string(kMostJsonValues) + " values: too large for a lens");
        if (at_ >= text_.size()) return fail("the file ends where a value should stand");
        switch (text_[at_]) {
            case '{':
                return object(out, depth);
            case '[':
                return array(out, depth);
            case '"':
                out.type = Json::Type::String;
                return string(out.string);
            case 't':
                out.boolean = true;
                return word("true", out, Json::Type::Bool);
            case 'f':
                return word("false", out, Json::Type::Bool);
            case 'n':
                return word("null", out, Json::Type::Null);
            default:
                return number(out);
        }
    }

    bool word(std::string_view expected, Json& out, Json::Type type) {
        if (text_.substr(at_, expected.size()) != expected) return fail("not a JSON value: " + excerpt());
        at_ += expected.size();
        out.type = type;
        return true;
    }

    bool number(Json& out) {
        std::size_t end = at_;
        const auto is_part = [](char c) {
            return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
        };
        while (end < text_.size() && is_part(text_[end])) ++end;
        const auto parsed = parse_number(text_.substr(at_, end - at_));
        if (end == at_ || !parsed || !std::isfinite(*parsed)) return fail("not a JSON value: " + excerpt());
        out.type = Json::Type::Number;
        out.number = *parsed;
        out.string = text_.substr(at_, end - at_);
        at_ = end;
        return true;
    }

    bool array(Json& out, int depth) {
        out.type = Json::Type::Array;
        ++at_;
        skip_space();
        if (next_is(']')) return ++at_, true;
        while (true) {
            skip_space();
            out.items.emplace_back();
            if (!value(out.items.back(), depth + 1)) return false;
            skip_space();
            if (next_is(']')) return ++at_, true;
            if (!next_is(',')) return fail("',' or ']' is missing in an array before " + excerpt());
            ++at_;
        }
    }

    bool object(Json& out, int depth) {
        out.type = Json::Type::Object;
        ++at_;
        skip_space();
        if (next_is('}')) return ++at_, true;
        while (true) {
            skip_space();
            std::string key;
            if (!next_is('"')) return fail("a key in quotes is missing before " + excerpt());
            if (!string(key)) return false;
            if (out.find(key)) return fail("\"" + key + "\" is given twice");
            skip_space();
            if (!next_is(':')) return fail("':' is missing after \"" + key + "\"");
            ++at_;
            skip_space();
            out.members.push_back({std::move(key), {}});
            if (!value(out.members.back().value, depth + 1)) return false;
            skip_space();
            if (next_is('}')) return ++at_, true;
            if (!next_is(',')) return fail("',' or '}' is missing in an object before " + excerpt());
            ++at_;
        }
    }

    bool string(std::string& out) {
        for (++at_; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '"') return ++at_, true;
            if (static_cast<unsigned char>(c) < 0x20) return fail("a string is not closed on its line");
            if (c != '\\') {
                out += c;
            } else if (!escape(out)) {
                return false;
            }
        }
        return fail("the file ends inside a string");
    }

    bool escape(std::string& out) {
        if (++at_ >= text_.size()) return fail("the file ends inside a string");
        switch (text_[at_]) {
            case '"':
                out += '"';
                return true;
            case '\\':
                out += '\\';
                return true;
            case '/':
                out += '/';
                return true;
            case 'b':
                out += '\b';
                return true;
            case 'f':
                out += '\f';
                return true;
            case 'n':
                out += '\n';
                return true;
            case 'r':
                out += '\r';
                return true;
            case 't':
                out += '\t';
                return true;
            case 'u':
                return unicode(out);
            default:
                return fail("unknown escape in a string");
        }
    }

    bool unicode(std::string& out) {
        auto code = hex4();
        if (!code) return fail("\\u needs four hexadecimal digits");
        if (*code >= 0xD800 && *code < 0xDC00 && text_.substr(at_ + 1, 2) == "\\u") {
            at_ += 2;
            const auto low = hex4();
            if (!low || *low < 0xDC00 || *low > 0xDFFF) return fail("half of a surrogate pair in a string");
            code = 0x10000 + ((*code - 0xD800) << 10) + (*low - 0xDC00);
        }
        append_utf8(out, *code);
        return true;
    }

    // The four digits after at_; leaves at_ on the last of them.
    std::optional<char32_t> hex4() {
        char32_t code = 0;
        for (int i = 0; i < 4; ++i) {
            if (++at_ >= text_.size()) return std::nullopt;
            const char c = text_[at_];
            if (c >= '0' && c <= '9')
                code = code * 16 + char32_t(c - '0');
            else if (c >= 'a' && c <= 'f')
                code = code * 16 + char32_t(c - 'a' + 10);
            else if (c >= 'A' && c <= 'F')
                code = code * 16 + char32_t(c - 'A' + 10);
            else
                return std::nullopt;
        }
        return code;
    }

    std::string excerpt() const { return quoted(text_.substr(at_, 20)); }

    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1, count_ = 0;
    std::optional<Error> error_;
};

}  // namespace

const Json* Json::find(std::string_view name) const {
    for (const auto& [key, value] : members)
        if (key == name) return &value;
    return nullptr;
}

Result<Json> parse_json(std::string_view text) { return Parser(text).parse(); }

}  // namespace petzval::lens_files
