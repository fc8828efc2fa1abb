// What stands around the picture. Every widget says a command.
#pragma once

#include "app.h"

namespace petzval::view {

void draw_panels(App& app);       // camera, depth, look, comparison, files
void draw_status_line(App& app);  // what is under the pointer; what is wrong
void draw_help(App& app);

}  // namespace petzval::view
