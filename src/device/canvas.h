// A frame on its way from what draws it to who wants it.
#pragma once

#include "petzval/image.h"

#include <utility>

namespace petzval::device {

// Pixels at home, in the host's memory, or away, on the device that draws them. What is away stays there
// until somebody asks for it.
class Canvas {
public:
    // In this memory, once at home; what it holds is no picture yet.
    explicit Canvas(Picture memory) : memory_(std::move(memory)) {}
    virtual ~Canvas() = default;
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    int width() const { return memory_.width(); }
    int height() const { return memory_.height(); }
    // At home, for reading and writing: comes there if it was away, and stays until a device draws again.
    // Throws Failed.
    View<Rgba> view() {
        come_home();
        return memory_.view();
    }
    Picture take() {
        come_home();
        return std::move(memory_);
    }

protected:
    virtual void come_home() {}
    Picture memory_;
};

// Where a verb draws: on a canvas, or in memory of the host.
class Target {
public:
    Target(View<Rgba> pixels) : pixels_(pixels) {}
    Target(Picture& pixels) : pixels_(pixels) {}
    Target(Canvas& canvas) : canvas_(&canvas) {}
    View<Rgba> view() const { return canvas_ ? canvas_->view() : pixels_; }
    Canvas* canvas() const { return canvas_; }  // null: the host's memory

private:
    View<Rgba> pixels_;
    Canvas* canvas_ = nullptr;
};

}  // namespace petzval::device
