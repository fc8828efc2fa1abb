#include "base/progress.h"

#include <algorithm>

namespace petzval {

bool Progress::advance(double share) {
    if (cancelled()) return false;
    const std::scoped_lock lock(mutex_);
    done_ = std::min(1.0, done_ + share);
    if (callback_ && !callback_(done_)) cancelled_ = true;
    return !cancelled();
}

}  // namespace petzval
