// Reading the next frame of a run while this one is made.
#pragma once

#include "petzval/shot_run.h"

#include <functional>
#include <future>
#include <memory>

namespace petzval::sequence {

// The shot of the frame that comes next, read by another thread while this one is made. Not where memory or
// threads are limited, and not where a picture has neighbours or other views, which are read anyway.
class ReadAhead {
public:
    static bool fits(const ShotRunSettings& settings) {
        const ReadOptions& read = settings.source.read;
        return read.max_memory_bytes == 0 && read.threads != 1 && settings.temporal == 0 &&
               read.view_name != kAllViews;
    }
    void begin(int frame, const ShotSource& source, const std::function<bool()>& cancelled) {
        frame_ = frame;
        shot_ = std::async(std::launch::async,
                           [source, cancelled] { return read_shot(source, {.cancelled = cancelled}); });
    }
    // Null where another frame was read, or none.
    std::shared_ptr<Result<Shot>> take(int frame) {
        if (!shot_.valid()) return nullptr;
        auto shot = std::make_shared<Result<Shot>>(shot_.get());
        return frame == frame_ ? shot : nullptr;
    }

private:
    int frame_ = 0;
    std::future<Result<Shot>> shot_;
};

}  // namespace petzval::sequence
