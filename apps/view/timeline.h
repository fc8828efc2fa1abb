// The frames of a shot, and the focus over them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace petzval::view {

struct Timeline {
    std::vector<int> frames;     // those that are there, ascending; empty: a single picture
    int frame = 0;               // that is shown
    int first = 0, last = 0;     // of what is played
    std::map<int, double> keys;  // focus distance in metres by frame
    bool keying = false;         // a click sets a key
    bool easing = false;         // slow at keys, faster between
    bool playing = false;

    bool is_shot() const { return !frames.empty(); }
    // The frame that is so many steps on from the one shown, within what is played if that has it.
    int stepped(int by) const;
    // Between keys evenly in dioptres, or eased there; before the first and behind the last as there. Nothing
    // without keys.
    std::optional<double> focus_at(int at) const;
    // What `defocus --track` reads: the keys, or where they are eased every frame between the first and the
    // last of them.
    std::string as_track() const;
};

class App;
// Into ImGui's current window, all of it.
void draw_timeline(App& app);

}  // namespace petzval::view
