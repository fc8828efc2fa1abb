// A strict, small JSON reader (RFC 8259) that remembers lines, so that errors can name them. Bounded in depth
// and count whatever the bytes.
#pragma once

#include "petzval/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace petzval::lens_files {

struct JsonMember;

struct Json {
    enum class Type { Null, Bool, Number, String, Array, Object };

    Type type = Type::Null;
    int line = 0;  // where the value starts, from 1
    bool boolean = false;
    double number = 0;
    std::string string;               // of a string; of a number, its digits as written
    std::vector<Json> items;          // of an array
    std::vector<JsonMember> members;  // of an object, as written

    bool is(Type wanted) const { return type == wanted; }
    // The member of that name; nullptr when there is none or this is not an object.
    const Json* find(std::string_view name) const;
};

struct JsonMember {
    std::string key;
    Json value;
};

inline constexpr int kDeepestJson = 32;
inline constexpr int kMostJsonValues = 300000;

// Errors: InvalidFile "line N: …" at the first character that is not JSON, at a key given twice, and beyond
// the limits above.
Result<Json> parse_json(std::string_view text);

}  // namespace petzval::lens_files
