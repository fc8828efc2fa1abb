// The frames of a shot, and the focus over them.
#pragma once

#include "petzval/track.h"

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
    int rack_clicks = 0;         // that a rack still waits for: 2, 1; 0: none is being made
    bool easing = false;         // slow at keys, faster between
    bool playing = false;
    double focus_speed = 0;  // at most, dioptres a frame; 0: whatever the keys ask for

    bool is_shot() const { return !frames.empty(); }
    // The frame that is so many steps on from the one shown, within what is played if that has it.
    int stepped(int by) const;
    // Focus between keys: linear in dioptres, or eased; constant before the first and after the last key;
    // delayed if faster than focus_speed. Nothing without keys.
    std::optional<double> focus_at(int at) const;
    std::map<int, double> focus_over(int from, int to) const;  // the same of many frames
    // A track for `defocus --track`: the keys; or, if they are eased or slowed, every frame from the first
    // key to the last, of a slowed one to the last frame.
    std::string as_track() const;

private:
    std::optional<Track> track() const;  // nothing without keys
};

}  // namespace petzval::view
