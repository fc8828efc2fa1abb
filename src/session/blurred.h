// A blurred frame: its report, and its picture where that was drawn.
#pragma once

#include "petzval/defocus.h"

#include "device/canvas.h"

#include <memory>

namespace petzval {

struct Blurred {
    DefocusReport report;
    std::shared_ptr<device::Canvas> canvas;  // holds the report's image; null: it is home
    Rect seen;                               // by an engine, in pixels of the display window

    void come_home() {
        if (canvas) report.image = canvas->take();
        canvas.reset();
    }
};

}  // namespace petzval
