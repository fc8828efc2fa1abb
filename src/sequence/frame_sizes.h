// Frames of one shot that differ in size, such as a proxy left among them.
#pragma once

#include "petzval/shot.h"

#include "records/record_json.h"

#include <string>

namespace petzval::sequence {

inline records::Json place_and_size(const Rect& r) {
    return {{"x", r.x0}, {"y", r.y0}, {"width", r.width()}, {"height", r.height()}};
}

class FrameSizes {
public:
    // Adds a warning to the record of a frame whose display window has another size than that of the frame
    // made before it. The record of a kept frame has no display window.
    void look_at(int frame, records::Json& record) {
        const records::Json window = record.value("display_window", records::Json(nullptr));
        if (!window.is_object()) return;
        const std::string size = window["width"].dump() + " x " + window["height"].dump() + " pixels";
        if (!size_.empty() && size != size_)
            record["warnings"].push_back("frame " + std::to_string(frame) + " has " + size +
                                         ", unlike frame " + std::to_string(frame_) + " with " + size_);
        frame_ = frame;
        size_ = size;
    }

private:
    int frame_ = 0;
    std::string size_;
};

}  // namespace petzval::sequence
