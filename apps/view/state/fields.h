// Settings and facts by name: camera.f_number, look fields, view.exposure; pick.depth_m.
#pragma once

#include "app.h"

#include <algorithm>
#include <string>
#include <vector>

namespace petzval::view {

inline Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

template <typename List, typename Value>
bool has(const List& list, const Value& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

// "fstop" -> "camera.f_number"; other names as they are.
std::string full_path(const std::string& name);
// The value as text for set_field(). Errors: InvalidArgument for an unknown name.
Result<std::string> field_text(const App& app, const std::string& name);
// Errors: InvalidArgument for an unknown name, or a text that is none of its values; nothing is changed then.
Status set_field(App& app, const std::string& name, const std::string& text);

// True if the field has a default and another value now.
bool is_changed(const App& app, const std::string& name);
// To its default; "look": all of the look. Errors: InvalidArgument for a field without one.
Status reset_field(App& app, const std::string& name);

// The text with the window's labels instead of field names.
std::string plain_words(const App& app, std::string text);
// The flag in words.
std::string label_of(const FieldRow& row);

// A number with so many digits as say it again exactly, or with `digits`.
std::string text_of(double value, int digits = 17);
// "2.76 px": to a hundredth, as nobody sees less.
std::string pixels_text(double px);
// Errors: InvalidArgument.
Result<double> number_of(const std::string& text);

}  // namespace petzval::view
