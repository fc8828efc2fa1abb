// The contents of a file: parts, windows, depth, camera numbers, range of light. Component petzval::files.
#pragma once

#include "petzval/camera.h"
#include "petzval/depth.h"
#include "petzval/dynamic_range.h"
#include "petzval/export.h"
#include "petzval/files.h"
#include "petzval/frame_loop.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace petzval {

struct Inspection {
    DynamicRange range;
    std::optional<FocusLimits> limits;  // empty if a camera number is missing
    std::string record;                 // JSON (records.h), as `petzval inspect --json` writes it
};
// kind: the meaning of the shot's depth. Blur radii up to permissible_radius_px count as sharp.
PETZVAL_API Inspection inspection_of(const Shot& shot, DepthKind kind, double permissible_radius_px);

// Reads a file and inspects it. `transfer`: the user's choice, which needs a display-referred file. The
// record also has the seconds and the memory. Errors: those of read_shot(); InvalidArgument for a transfer
// curve of scene-linear light.
struct InspectFile {
    ShotSource source;  // the kind of its depth holds for the inspection
    std::optional<Transfer> transfer = {};
    double permissible_radius_px = 1;
};
struct InspectedFile {
    Shot shot;
    Inspection seen;
};
PETZVAL_API Result<InspectedFile> inspect_file(const InspectFile& file, const Control& control = {});
// The findings as text for people: parts, depth, camera, light, warnings. `file` is what was inspected.
// in_words: the host's names of fields, such as "--fstop" for camera.f_number; empty: the fields. Names from
// the file are not made printable.
PETZVAL_API std::string inspection_text(const InspectFile& file, const InspectedFile& inspected,
                                        const std::function<std::string(const std::string&)>& in_words = {});

// All frames of a shot: paths hold a frame number (frames.h). The work of a FrameLoop; `inspected` is called
// after each frame that could be read. Of `host`, only `cancelled` is called.
PETZVAL_API FrameWork work_of(const InspectFile& file, const FrameLoopHost& host,
                              const std::function<void(int frame, const InspectedFile&)>& inspected);

// The inspected frames of a shot, collected frame by frame.
class PETZVAL_API InspectedShot {
public:
    void add(int frame, const InspectedFile& inspected);
    // A line for each value that is the same in all frames, then a table of the others with one row per
    // frame; empty without frames. Names from the files are not made printable.
    std::string text() const;

private:
    using Value = std::pair<std::string, std::string>;  // its name, and what it is
    static std::vector<Value> values_of(const InspectedFile& inspected);
    bool changes(std::size_t column) const;
    std::vector<int> frames_;
    std::vector<std::vector<Value>> rows_;
};

// JSON of a file without its pixels (read_frame_header()): {"parts": […], "display_window": [x0, y0, x1, y1],
// "data_window", "pixel_aspect", "views": […], "camera": {NAME: {"value", "origin"}}, "detected": […],
// "warnings": […]}.
PETZVAL_API std::string header_json(const Frame& header);

}  // namespace petzval
