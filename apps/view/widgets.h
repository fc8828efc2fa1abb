// Fields as widgets. Typing and dragging issue the command `set`.
#pragma once

#include "app.h"

#include <string>

namespace petzval::view {

// A number that is dragged, by shares of itself where `is_scale`, else by `speed`.
void number_widget(App& app, const std::string& path, const std::string& label, double speed, bool is_scale);
// The same between two ends.
void slider_widget(App& app, const std::string& path, const std::string& label, double least, double most);
// On or off.
void switch_widget(App& app, const std::string& path, const std::string& label);
// A row of the table of look flags: switch, choice, number or text, as its placeholder says.
// `called`: its label; empty: its flag in words.
void row_widget(App& app, const FieldRow& row, const std::string& called = "");
// The next widget, so wide, stands beside the last one, or below it where that would be cut off.
void flow(float width);
// A button that does so.
bool flowing_button(const char* label);
// The last widget can be pointed at by this name in scripts, and says this when the pointer rests on it.
void is_field(App& app, const std::string& path, const std::string& help = "");

}  // namespace petzval::view
