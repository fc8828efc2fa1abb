// The contents of a file: parts, windows, depth, camera numbers, range of light. Component petzval::files.
#pragma once

#include "petzval/camera.h"
#include "petzval/depth.h"
#include "petzval/dynamic_range.h"
#include "petzval/export.h"
#include "petzval/files.h"
#include "petzval/shot.h"

#include <optional>
#include <string>

namespace petzval {

struct Inspection {
    DynamicRange range;
    std::optional<FocusLimits> limits;  // empty if a camera number is missing
    std::string record;                 // JSON (records.h), as `petzval inspect --json` writes it
};
// kind: the meaning of the shot's depth. Blur radii up to permissible_radius_px count as sharp.
PETZVAL_API Inspection inspection_of(const Shot& shot, DepthKind kind, double permissible_radius_px);

// JSON of a file without its pixels (read_frame_header()): {"parts": […], "display_window": [x0, y0, x1, y1],
// "data_window", "pixel_aspect", "views": […], "camera": {NAME: {"value", "origin"}}, "detected": […],
// "warnings": […]}.
PETZVAL_API std::string header_json(const Frame& header);

}  // namespace petzval
