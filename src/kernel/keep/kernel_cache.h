// Kernels in memory: each is made once, the ones not asked for longest go first.
#pragma once

#include "kernel/model/lens_model.h"

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>

namespace petzval::kernel {

// Thread-safe. Of two threads that ask for the same new kernel one makes it and the other waits for it.
template <typename Key>
class KernelCache {
public:
    explicit KernelCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    // make(): the kernel of this key, a PointSpread. It may ask the cache for others, but not for this one.
    template <typename Make>
    std::shared_ptr<const PointSpread> get(const Key& key, const Make& make) {
        std::shared_ptr<Slot> slot;
        {
            const std::lock_guard lock(mutex_);
            std::shared_ptr<Slot>& found = slots_[key];
            if (!found) {
                found = std::make_shared<Slot>();
                found->place = recent_.insert(recent_.begin(), key);
            }
            slot = found;
            recent_.splice(recent_.begin(), recent_, slot->place);
        }
        const std::lock_guard making(slot->making);
        if (!slot->kernel) {
            slot->kernel = std::make_shared<const PointSpread>(make());
            keep(slot);
        }
        return slot->kernel;
    }

    std::size_t kernels() const {
        const std::lock_guard lock(mutex_);
        return slots_.size();
    }
    std::size_t bytes() const {
        const std::lock_guard lock(mutex_);
        return bytes_;
    }
    // Drops the kernels not asked for longest until at most so many bytes are held.
    void trim(std::size_t max_bytes) {
        const std::lock_guard lock(mutex_);
        drop_to(max_bytes, nullptr);
    }

private:
    struct Slot {
        std::mutex making;
        std::shared_ptr<const PointSpread> kernel;
        typename std::list<Key>::iterator place;
        std::size_t bytes = 0;  // 0: being made
    };

    // Counts a new kernel and drops the ones that were not asked for longest.
    void keep(const std::shared_ptr<Slot>& slot) {
        const std::lock_guard lock(mutex_);
        slot->bytes = slot->kernel->weights.bytes() + sizeof(Slot) + sizeof(PointSpread);
        bytes_ += slot->bytes;
        drop_to(max_bytes_, slot.get());
    }

    // A slot that is being made is not counted yet and stays, as does `newest`. Requires: the lock.
    void drop_to(std::size_t max_bytes, const Slot* newest) {
        for (auto last = recent_.end(); bytes_ > max_bytes && last != recent_.begin();) {
            --last;
            const auto old = slots_.find(*last);
            if (old->second.get() == newest || old->second->bytes == 0) continue;
            bytes_ -= old->second->bytes;
            slots_.erase(old);
            last = recent_.erase(last);
        }
    }

    const std::size_t max_bytes_;
    mutable std::mutex mutex_;  // of all below
    std::map<Key, std::shared_ptr<Slot>> slots_;
    std::list<Key> recent_;  // most recently used first
    std::size_t bytes_ = 0;
};

}  // namespace petzval::kernel
