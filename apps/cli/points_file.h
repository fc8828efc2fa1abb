// Lights in a CSV file.
//
// The first line that is not empty names the columns, in any order: x, y (pixels of the display window,
// centres at +0.5), depth (metres, planar) or coc (signed radius, px), r, g, b (scene-linear), and if wanted
// size (diameter, px); vx and vy are read over. '#' begins a comment; values may be inf or nan.
#pragma once

#include "petzval/defocus.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval::cli {

struct PointsFile {
    std::vector<LightPoint> points;  // in pixels of the data window
    bool has_depth = false;          // false: radii
};

// Errors: InvalidFile with the path and the line (missing, no header, a column missing, twice or unknown, a
// value missing, too many, or not a number).
Result<PointsFile> read_points(const std::string& path, const Rect& data_window);

// Points by depth, written so that read_points() reads the same floats again. `comment`: lines without '#'.
// Errors: OutputFailed.
Status write_points(const std::string& path, const std::vector<LightPoint>& points,
                    const std::vector<std::string>& comment);

}  // namespace petzval::cli
