// Frame numbers, and file names that contain them. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace petzval {

// "1001-1100x2,1200": single frames, ranges, and every n-th frame of a range from its beginning, separated
// by commas. Numbers may be negative ("-10--5") and ranges may fall. Returns each frame once, in the order
// named. Errors: InvalidArgument; "1-100:3", which means every third frame in some programs and all frames
// in another order in others, is refused with both spellings; so are more than a million frames.
PETZVAL_API Result<std::vector<int>> parse_frames(std::string_view text);
// The shortest text that names the same frames in the same order.
PETZVAL_API std::string frames_text(std::span<const int> frames);

// A path whose file name holds a frame number: '#' for each digit ("beauty.####.exr"), or as printf writes it
// ("beauty.%04d.exr"). Numbers with more digits than that are written whole.
class PETZVAL_API FramePattern {
public:
    // Empty if the path has no frame number: an existing file "take #2.exr" is one picture, and the name of
    // an existing folder holds none. Errors: InvalidArgument for two frame numbers, for one in a folder's
    // name, and for more than 12 digits.
    static Result<std::optional<FramePattern>> find(std::string_view path);

    std::string path(int frame) const;
    // The number in the name of a file in the same folder, if it matches this pattern.
    std::optional<int> frame_of(std::string_view file_name) const;
    // Numbers of the existing files, ascending. Errors: InvalidFile for a folder that cannot be read.
    Result<std::vector<int>> frames_there() const;
    // Names of the existing files that differ from this pattern only in the number of digits, sorted; the
    // same errors.
    Result<std::vector<std::string>> of_other_digits() const;

private:
    std::optional<int> number_in(std::string_view file_name) const;
    Result<std::vector<std::string>> files_there() const;

    std::string folder_, before_, after_;  // folder_ ends with '/', or is empty
    int digits_ = 1;
};

// True if the path has one place for a frame number.
PETZVAL_API bool has_frame_number(const std::string& path);
// The path of a frame; a path without a frame number, or with two, is returned unchanged.
PETZVAL_API std::string at_frame(const std::string& path, int frame);

}  // namespace petzval
