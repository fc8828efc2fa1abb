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
    MotionReading motion_reading() const;
};

// Their files for that frame: no name has a place for a number any more.
DefocusFlags at_frame(DefocusFlags flags, int frame);

// Numbers that a track changes are the track's, whatever was typed.
void name_track(const TrackedFrame& tracked, FoundCamera& camera);

// True if the flags describe more than one frame. Throws UsageError if they contradict each other.
bool is_sequence(const DefocusFlags& flags);

// Makes one frame: its flags, whose files have no place for a number any more. Returns its report.
using MakeFrame = std::function<Result<Json>(DefocusFlags&)>;
// make_frames() of all of them. Errors: also those of the track. Throws FramesFailed.
Status defocus_frames(const DefocusFlags& flags, const MakeFrame& make);

}  // namespace petzval::cli
