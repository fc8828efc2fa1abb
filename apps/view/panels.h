// What stands around the picture. Every widget says a command.
#pragma once

#include "petzval/deep.h"

#include "app.h"

#include <span>
#include <string>

namespace petzval::view {

void draw_panels(App& app);       // camera, depth, look, comparison, files
void draw_status_line(App& app);  // what is under the pointer; what is wrong
void draw_help(App& app);
// Where the picture lies in depth; into the current window, as the next.
void depth_panel(App& app);
// How much samples of a pixel, nearest first, cover from the front, over depth; a step a sample, in its
// colour.
void coverage_plot(App& app, const std::string& name, std::span<const DeepSample> samples);
// What a frame took, pass by pass; a line of it.
void time_row(double seconds, const std::string& words);
void stage_times(const MadeFrame& made);

}  // namespace petzval::view
