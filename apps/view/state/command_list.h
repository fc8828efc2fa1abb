// Commands that commands() lists, by the files they are in.
#pragma once

#include "commands.h"

namespace petzval::view {

// scene_commands.cpp
Status orbit(App& app, const std::vector<std::string>& words);
Status dolly(App& app, const std::vector<std::string>& words);
Status home(App& app, const std::vector<std::string>& words);
Status save_path(App& app, const std::vector<std::string>& words);
Status load_path(App& app, const std::vector<std::string>& words);
Status forget_path(App& app, const std::vector<std::string>& words);
Status record(App& app, const std::vector<std::string>& words);

// sheet_commands.cpp
Status sheet(App& app, const std::vector<std::string>& words);

// shot_commands.cpp
Status frame(App& app, const std::vector<std::string>& words);
Status range(App& app, const std::vector<std::string>& words);
Status key_focus(App& app, const std::vector<std::string>& words);
Status rack(App& app, const std::vector<std::string>& words);
Status move_key(App& app, const std::vector<std::string>& words);
Status remove_key(App& app, const std::vector<std::string>& words);
Status save_track(App& app, const std::vector<std::string>& words);
Status load_track(App& app, const std::vector<std::string>& words);
// A click while a rack waits for it.
Status rack_to(App& app, double focus_m);

}  // namespace petzval::view
