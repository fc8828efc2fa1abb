// Shared by all EXR writers: files that appear complete or not at all, and values that fit the format.
#pragma once

#include "petzval/files.h"
#include "petzval/result.h"

#include "files/layout.h"

#include <cmath>
#include <exception>
#include <functional>
#include <string>

#include <OpenEXR/ImfIO.h>

namespace petzval {

// Leaves OpenEXR's loops with an error of our own.
struct Failure : std::exception {
    explicit Failure(Error e) : error(std::move(e)) {}
    const char* what() const noexcept override { return error.message.c_str(); }
    Error error;
};

// Opens the output, lets `body` write to it, and puts it in place if all went well.
Status write_exr_file(const std::string& path, bool overwrite,
                      const std::function<Status(Imf::OStream&)>& body);

Channel plain_channel(const std::string& name, ChannelType type);

// `value` as a file may hold it: NaN becomes 0, what lies beyond `largest` the largest half; both are
// counted.
inline float storable(float value, float largest, WriteReport& report) {
    if (std::abs(value) <= largest) return value;
    ++(std::isfinite(value) ? report.clamped_to_half : report.non_finite);
    return std::isnan(value) ? 0.f : std::copysign(kLargestHalf, value);
}

}  // namespace petzval
