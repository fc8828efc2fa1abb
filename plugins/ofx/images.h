// Images that the host lends, and where they lie in the frame.
#pragma once

#include "petzval/petzval_c.h"
#include "petzval/place.h"

#include "coding.h"
#include "host.h"

#include <cstddef>
#include <string>
#include <vector>

namespace petzval::plugin {

// An image of a named clip; given back when this ends.
class LentImage {
public:
    LentImage() = default;
    // Not there: the clip is not connected, or has no image at that time.
    LentImage(ofx::Effect* effect, const char* name, ofx::Time time);
    ~LentImage();
    LentImage(const LentImage&) = delete;
    LentImage& operator=(const LentImage&) = delete;

    bool is_there() const { return image_.handle() != nullptr; }
    // False for images that are not of floats, have no pixels or no memory.
    bool is_readable() const { return channels_ != 0; }
    int channels() const { return channels_; }
    const ofx::RectI& bounds() const { return bounds_; }
    int width() const { return bounds_.x2 - bounds_.x1; }
    int height() const { return bounds_.y2 - bounds_.y1; }
    std::ptrdiff_t row_bytes() const { return row_bytes_; }
    char* pixel(int x, int y) const {
        return data_ + std::ptrdiff_t(y - bounds_.y1) * row_bytes_ +
               std::ptrdiff_t(x - bounds_.x1) * channels_ * std::ptrdiff_t(sizeof(float));
    }
    // A channel at a pixel of the clip; `outside` beyond the image.
    float value(int x, int y, int channel, float outside) const;
    // True if rows and pixels lie as floats must.
    bool is_aligned() const;
    Coding coding(Transfer transfer) const { return {transfer, unpremultiplied_}; }
    double pixel_aspect() const { return pixel_aspect_; }
    const ofx::RectI& region() const { return region_; }

private:
    Properties image_{nullptr};
    ofx::RectI bounds_{}, region_{};
    std::ptrdiff_t row_bytes_ = 0;
    char* data_ = nullptr;
    int channels_ = 0;
    bool unpremultiplied_ = false;
    double pixel_aspect_ = 1;
};

bool is_connected(ofx::Effect* effect, const char* name);

// Pixels of the host, y up, to pixels of petzval, y down from the top left of the frame.
struct FrameOfHost {
    ofx::RectI display{};  // the frame, in the host's pixels at this render scale
    double pixel_aspect = 1;

    Rect rect(const ofx::RectI& r) const {
        return {r.x1 - display.x1, display.y2 - r.y2, r.x2 - display.x1, display.y2 - r.y1};
    }
};

// The project, or the clip Source where the sensor spans that or the host names no project.
FrameOfHost frame_of(ofx::Effect* effect, const LentImage& source, ofx::Point scale, bool spans_source);

ofx::RectI intersected(const ofx::RectI& a, const ofx::RectI& b);
inline bool is_empty(const ofx::RectI& r) { return r.x2 <= r.x1 || r.y2 <= r.y1; }

// A part of an image in the host's own memory. Requires: 4 channels, `part` inside of it.
petzval_pixels pixels_of(const LentImage& image, const ofx::RectI& part);

// RGBA of an image in memory of ours, top row first: premultiplied light. opaque: alpha counts as 1.
std::vector<float> light_of(const LentImage& image, const Coding& coding, bool opaque);
petzval_pixels pixels_of(std::vector<float>& rgba, int width, int height);

}  // namespace petzval::plugin
