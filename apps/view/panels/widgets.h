// Fields as widgets. Typing and dragging issue the command `set`.
#pragma once

#include "app.h"

#include <cstdint>
#include <string>

namespace petzval::view {

inline constexpr std::uint32_t kAmber = 0xff3cb4ffU;  // ABGR: what is assumed

// A number that is dragged, by shares of itself where `is_scale`, else by `speed`.
void number_widget(App& app, const std::string& path, const std::string& label, double speed, bool is_scale);
// Ends of a slider, and its number as printf() writes it, with its unit.
struct Ends {
    double least = 0, most = 1;
    const char* format = "%.3g";
    bool is_scale = false;  // the same way for the same factor
};
// The same between two ends; Ctrl-click types a number beyond them.
void slider_widget(App& app, const std::string& path, const std::string& label, const Ends& ends,
                   const std::string& help = "");
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
