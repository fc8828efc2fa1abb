// A short video, made by ffmpeg where it is installed.
#pragma once

#include "petzval/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace petzval::sequence {

// The file appears complete or not at all.
class Video {
public:
    Video() = default;
    ~Video();
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    // Requires: even width and height. Errors: OutputFailed, also where there is no ffmpeg.
    Status open(const std::string& path, int width, int height, double frames_per_second);
    // 8-bit RGB, rows from the top. Errors: OutputFailed.
    Status add(const std::vector<std::uint8_t>& rgb);
    // Errors: OutputFailed.
    Status finish();

private:
    Status failed(const std::string& why) const;
    std::string path_, unfinished_;
    int pipe_ = -1, process_ = -1;
};

}  // namespace petzval::sequence
