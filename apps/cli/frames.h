// Many frames by one command: which, from which files to which, what changes over them.
#pragma once

#include "petzval/frames.h"
#include "petzval/track.h"

#include "flags.h"
#include "report.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct DefocusFlags;

// What to do about a frame whose files are not all there.
enum class Missing { Fail, Skip, Black };

struct FrameFlags {
    std::vector<int> frames;  // empty: one frame, or those that are there
    std::optional<Missing> missing;
    std::string track;
    std::optional<double> focus_speed;  // dioptres per frame
    std::string report;                 // a file with one record a frame

    void add_to(Verb& verb);
    std::vector<std::string> given() const;
};

// Frames of a shot that failed where others were made: exit code 4.
struct FramesFailed {
    std::string message;
};

// Whether the flags are about more than one frame. Throws UsageError where they do not fit each other.
bool is_sequence(const DefocusFlags& flags);

// Makes one frame: its flags, whose files have no place for a number any more. Returns its report.
using MakeFrame = std::function<Result<Json>(DefocusFlags&)>;
// Makes all of them, one after the other; one that fails does not keep the others from being made. Errors:
// those of the list, the track and the files that lack, before any frame is made; Cancelled. Throws
// FramesFailed.
Status make_frames(const DefocusFlags& flags, const MakeFrame& make);

}  // namespace petzval::cli
