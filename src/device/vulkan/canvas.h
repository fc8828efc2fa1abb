// A frame on the device, and its transfers.
#pragma once

#include "device/canvas.h"
#include "device/vulkan/driver/recording.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {

// A canvas whose pixels move to the device when something is drawn on it there. Throws Failed.
class DeviceCanvas final : public Canvas {
public:
    DeviceCanvas(Context& context, Picture memory) : Canvas(std::move(memory)), context_(context) {}

    // Its pixels on the device, for writing; null: they are in host memory, because the device has no room.
    const Piece* drawn_on();
    // Its pixels on the device, uploaded if necessary; null: they are too many.
    const Piece* sent();
    // Its pixels on the device; null: they are in host memory, or do not exist yet.
    const Piece* away() const { return is_home_ || pixels_.size() == 0 ? nullptr : &pixels_; }

private:
    void come_home() override;
    void bring_home(std::size_t begin, std::size_t pixels);
    bool fits() const { return !memory_.empty() && memory_.bytes() <= context_.most_range_bytes(); }
    bool has_room();

    Context& context_;
    bool is_home_ = false;  // else away, or nowhere yet
    Piece pixels_;
};

// Brings the result of a recording to a target: on the device if the target's pixels are there, otherwise to
// the host's memory.
class Delivery {
public:
    Delivery(Context& context, Target out);
    bool is_away() const { return away_ != nullptr; }

    // Copies squares of side x side pixels, one after the other, to places no larger. adds: adds to the
    // existing pixels.
    void squares(Recording& recording, const Piece& drawn, std::span<const Rect> places, int side,
                 bool adds = false);
    // Rows y0…y1 - 1, of a piece that begins with row `first`.
    void rows(Recording& recording, const Piece& drawn, int first, int y0, int y1);
    // Call it after the recording has run.
    void finish();

private:
    Context& context_;
    const Target out_;
    const Piece* away_ = nullptr;
    // Pixels in the recording's memory for the host: `side` per row of a place, `square` from one place to
    // the next.
    const Rgba* seen_ = nullptr;
    std::vector<Rect> places_;
    int side_ = 0;
    std::size_t square_ = 0;
    bool adds_ = false;
    Piece words_;
};

}  // namespace petzval::device::vulkan
