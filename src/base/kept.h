// Results that are kept from frame to frame, because they take longer to make than to look up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace petzval {

// Values by key, while they fit. Key: has ==; Value: has bytes(). Any number of threads may use it at once.
template <typename Key, typename Value>
class Kept {
public:
    // The value of this key: that of a frame before, or make(), which is kept.
    template <typename Make>
    std::shared_ptr<const Value> get(const Key& key, const Make& make) {
        if (auto known = find(key)) return known;
        // Without the lock: frames that are made side by side may both make it, and neither waits.
        auto made = std::make_shared<const Value>(make());
        const std::lock_guard lock(mutex_);
        std::erase_if(values_, [&](const auto& v) { return v.first == key; });
        values_.emplace_front(key, made);
        return made;
    }
    std::size_t bytes() const {
        const std::lock_guard lock(mutex_);
        std::size_t sum = 0;
        for (const auto& [key, value] : values_) sum += value->bytes();
        return sum;
    }
    // Lets go of those not used longest, until at most so many bytes are kept.
    void trim(std::size_t max_bytes) {
        const std::lock_guard lock(mutex_);
        std::size_t sum = 0;
        std::erase_if(values_, [&](const auto& v) { return (sum += v.second->bytes()) > max_bytes; });
    }

private:
    std::shared_ptr<const Value> find(const Key& key) {
        const std::lock_guard lock(mutex_);
        const auto known =
            std::find_if(values_.begin(), values_.end(), [&](const auto& v) { return v.first == key; });
        if (known == values_.end()) return nullptr;
        values_.splice(values_.begin(), values_, known);
        return known->second;
    }

    mutable std::mutex mutex_;
    std::list<std::pair<Key, std::shared_ptr<const Value>>> values_;  // the last used first
};

}  // namespace petzval
