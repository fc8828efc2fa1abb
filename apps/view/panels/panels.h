// Panels around the picture. Every widget issues a command.
#pragma once

#include "petzval/deep.h"

#include "app.h"

#include <span>
#include <string>

namespace petzval::view {

void draw_panels(App& app);       // camera, depth, look, comparison, files
void draw_status_line(App& app);  // what is under the pointer; what is wrong
void draw_menu(App& app);         // into the current window's menu bar
void draw_sheet(App& app);        // the window of the contact sheet
void draw_open(App& app);         // the window in which a file is chosen
void input_panel(App& app);       // layers, depth. Requires: a shot
void camera_panel(App& app);
void look_panel(App& app);
void draw_help(App& app);
void draw_timeline(App& app);  // of a shot: its frames and the focus over them
// Histogram of the picture's depth; into the current window, like the following.
void depth_panel(App& app);
// Histogram of the light of the picture that is shown, over stops.
void light_plot(App& app);
// Plot of accumulated coverage over depth for the samples of a pixel, nearest first; one step per sample, in
// its colour.
void coverage_plot(App& app, const std::string& name, std::span<const DeepSample> samples);
// One line of the times of a frame's passes.
void time_row(double seconds, const std::string& words);
void stage_times(const MadeFrame& made);

}  // namespace petzval::view
