#include "device/memory.h"

namespace petzval::device {

// The entries that were unused for longest go first: each shrinks to the bytes that the others leave it, and
// is dropped if that is nothing.
void Memory::trim(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    const std::size_t most = std::min(bytes, max_bytes_);
    std::size_t held = 0;
    for (auto at = things_.begin(); at != things_.end();) {
        const std::size_t left = most - std::min(most, held);
        Thing& thing = *at->second;
        if (thing.bytes() > left) thing.trim(left);
        if (thing.bytes() > left) {
            at = things_.erase(at);
            continue;
        }
        held += thing.bytes();
        ++at;
    }
}

}  // namespace petzval::device
