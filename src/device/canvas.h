// A frame on its way from the device that draws it to the host that reads it.
#pragma once

#include "petzval/image.h"

#include <utility>

namespace petzval::device {

// Pixels in the host's memory, or on the device that draws them. Pixels on a device stay there until somebody
// asks for them.
class Canvas {
public:
    // Host memory to draw into; its content is not a picture yet.
    explicit Canvas(Picture memory) : memory_(std::move(memory)) {}
    virtual ~Canvas() = default;
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    int width() const { return memory_.width(); }
    int height() const { return memory_.height(); }
    // The pixels in the host's memory, for reading and writing. Copies them from the device if they are
    // there; they stay in the host's memory until a device draws again. Throws Failed.
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

// The place that a verb draws to: a canvas, or memory of the host.
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
