// Shows the frames of a shot side by side on a contact sheet, or one after the other in a video. Component
// petzval::files.
#pragma once

#include "petzval/display_files.h"
#include "petzval/export.h"
#include "petzval/frame_loop.h"
#include "petzval/shot.h"

#include <optional>
#include <string>

namespace petzval {

struct ShotSheet {
    ShotSource source;                      // its path holds a frame number (frames.h); depth is not read
    DisplayChoice display = {};             // the development of each frame
    std::optional<Transfer> transfer = {};  // as the user gave it
    std::string output;                     // .png: a contact sheet; is_video(): a video, made by ffmpeg
    int columns = 0;                        // of a contact sheet; 0: about as wide as high
    std::optional<int> width_px =
        {};  // of a frame; not given: 320 on a sheet, its own in a video, 1920 at most
    std::optional<double> frames_per_second = {};  // of a video; not given: 24
    bool labels = true;                            // the frame number in each frame
    int threads = 0;                               // 0: all
    bool overwrite = true;                         // false: an existing contact sheet is an error
};

// True for the extensions .mp4, .mov, .mkv and .webm.
PETZVAL_API bool is_video(const std::string& path);

// Refuses an output that is neither a PNG nor a video, columns of a video, and a rate of a contact sheet.
// Errors: InvalidArgument.
PETZVAL_API Status check(const ShotSheet& sheet);

// The work of a FrameLoop. The first readable frame gives the size of all; a frame of another shape keeps its
// shape, centred on black. The file is written once all frames are done. Of `host`, only `say` and
// `cancelled` are called. Errors of frames: those of check() and read_shot(); of the file: OutputFailed, also
// if a video is requested and ffmpeg is not installed; InvalidFile if no frame could be read.
PETZVAL_API FrameWork work_of(ShotSheet settings, FrameLoopHost host = {});

}  // namespace petzval
