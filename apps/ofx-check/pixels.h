// Memory of images, guarded: what is written or read where it may not be is found.
#pragma once

#include "ofx.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ofx_check {

// Floats, RGBA or fewer channels, over a rectangle of pixels; bottom row first.
struct Picture {
    ofx::RectI bounds{};
    int channels = 4;
    std::vector<float> values;

    int width() const { return bounds.x2 - bounds.x1; }
    int height() const { return bounds.y2 - bounds.y1; }
    Picture() = default;
    Picture(const ofx::RectI& where, int channel_count);
    float& at(int x, int y, int channel) { return values[index(x, y, channel)]; }
    float at(int x, int y, int channel) const { return values[index(x, y, channel)]; }
    bool holds(int x, int y) const {
        return x >= bounds.x1 && x < bounds.x2 && y >= bounds.y1 && y < bounds.y2;
    }

private:
    std::size_t index(int x, int y, int channel) const {
        return (std::size_t(y - bounds.y1) * std::size_t(width()) + std::size_t(x - bounds.x1)) *
                   std::size_t(channels) +
               std::size_t(channel);
    }
};

enum class Depth { Float, Short, Byte };
std::size_t bytes_of(Depth depth);

// Layout of rows in memory.
struct Layout {
    bool flipped = false;  // row bytes are negative
    int padding = 0;       // bytes after each row
};

// An image in separate pages, between pages that nobody may touch.
class GuardedImage {
public:
    // Holds the picture's values; `sentinel`: a bit pattern in all pixels instead.
    GuardedImage(const Picture& picture, Depth depth, const Layout& layout, bool sentinel);
    ~GuardedImage();
    GuardedImage(const GuardedImage&) = delete;
    GuardedImage& operator=(const GuardedImage&) = delete;

    void* data() const { return first_row_; }
    int row_bytes() const { return row_bytes_; }
    void make_read_only();
    // Every later access is a finding. The pages stay reserved.
    void give_back();
    // Values as floats; NaN where the sentinel still stands.
    Picture read() const;
    // True if the bytes around the rows are as they were.
    bool surroundings_are_whole() const;

private:
    char* row(int y) const { return first_row_ + std::ptrdiff_t(y) * row_bytes_; }

    ofx::RectI bounds_;
    int channels_;
    Depth depth_;
    char* pages_ = nullptr;
    std::size_t page_bytes_ = 0;
    char *first_row_ = nullptr, *begin_ = nullptr,
         *end_ = nullptr;  // of the rows; begin_ is the lowest address
    int row_bytes_ = 0, slot_ = -1;
};

// Exit status of a process that touched guarded memory.
inline constexpr int kMemoryTouched = 3;
// Turns an access to guarded memory into a finding, and ends the process.
void watch_memory();

}  // namespace ofx_check
