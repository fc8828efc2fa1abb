// The frames of a shot for `defocus`: what a track changes over them.
#pragma once

#include "petzval/motion.h"
#include "petzval/track.h"

#include "frames.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct DefocusFlags;

struct TrackFlags {
    std::string file;
    std::vector<std::string> rack;      // keys, as 1001:80,45 or 1024:3.2m
    std::optional<double> focus_speed;  // dioptres per frame
    int temporal = 0;                   // frames on each side
    std::string motion;                 // a layer, or "off"
    std::optional<MotionScale> motion_scale;

    void add_to(Verb& verb);
    std::vector<std::string> given() const;
    MotionReading reading() const;
    // "1024:3.2m" has a unit, as --focus has. Throws UsageError if a value is not a length.
    std::vector<std::string> rack_in_metres() const;
};

// True if the flags describe more than one frame. Throws UsageError if they contradict each other.
bool is_sequence(const DefocusFlags& flags);

}  // namespace petzval::cli
