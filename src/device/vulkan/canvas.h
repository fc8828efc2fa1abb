// A frame on the device, and the way of what was drawn to it.
#pragma once

#include "device/canvas.h"
#include "device/vulkan/recording.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {

// Goes to the device when something is drawn on it there. Throws Failed.
class DeviceCanvas final : public Canvas {
public:
    DeviceCanvas(Context& context, Picture memory) : Canvas(std::move(memory)), context_(context) {}

    // Where its pixels are, to be written; null: they are at home, as there is no room for them here.
    const Piece* drawn_on();
    // Where its pixels are, sent there if they were at home; null: they are too many.
    const Piece* sent();
    // Where its pixels are; null: at home, or nowhere yet.
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

// Brings what a recording drew to a target: on the device where that is away, else to the host's memory.
class Delivery {
public:
    Delivery(Context& context, Target out);
    bool is_away() const { return away_ != nullptr; }

    // Squares of side x side pixels, one after the other, to places no larger. adds: to what is there.
    void squares(Recording& recording, const Piece& drawn, std::span<const Rect> places, int side,
                 bool adds = false);
    // Rows y0…y1 - 1, of a piece that begins with row `first`.
    void rows(Recording& recording, const Piece& drawn, int first, int y0, int y1);
    // Once the recording was run.
    void finish();

private:
    Context& context_;
    const Target out_;
    const Piece* away_ = nullptr;
    // At home, pixels lie in the recording's memory, each place's `side` to a row and `square` from the next.
    const Rgba* seen_ = nullptr;
    std::vector<Rect> places_;
    int side_ = 0;
    std::size_t square_ = 0;
    bool adds_ = false;
    Piece words_;
};

}  // namespace petzval::device::vulkan
