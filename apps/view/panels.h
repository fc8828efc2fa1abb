// What stands around the picture. Every widget says a command.
#pragma once

#include "app.h"

#include <string>

namespace petzval::view {

void draw_panels(App& app);       // camera, depth, look, comparison, files
void draw_status_line(App& app);  // what is under the pointer; what is wrong
void draw_help(App& app);
// Where the picture lies in depth; into the current window, as the next.
void depth_panel(App& app);
// What a frame took, pass by pass; a line of it.
void time_row(double seconds, const std::string& words);
void stage_times(const MadeFrame& made);

}  // namespace petzval::view
