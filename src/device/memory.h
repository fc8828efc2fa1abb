// Things that may outlive a frame: kernels, ready for a device or on their way there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace petzval::device {

// Data that a device keeps from one plan to the next, such as a copy of a list in its memory.
struct Kept {
    Kept() = default;
    virtual ~Kept() = default;
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;
};

// Things by name under one budget of bytes; the one that was unused for longest goes first. No result depends
// on whether a thing was kept. Thread-safe; a thing stays alive as long as somebody holds it.
class Memory {
public:
    explicit Memory(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    struct Thing {
        Thing() = default;
        virtual ~Thing() = default;
        Thing(const Thing&) = delete;
        Thing& operator=(const Thing&) = delete;
        virtual std::size_t bytes() const = 0;
        // Drops what it can do without, until it takes no more than this.
        virtual void trim(std::size_t max_bytes) { (void)max_bytes; }
    };

    // The thing of this name, made by make() if there is none: a shared_ptr<T>. A name stands for one T.
    template <typename T, typename Make>
    std::shared_ptr<T> get(const std::string& name, const Make& make) {
        const std::lock_guard lock(mutex_);
        auto known =
            std::find_if(things_.begin(), things_.end(), [&](const auto& t) { return t.first == name; });
        if (known == things_.end()) known = things_.insert(things_.begin(), {name, make()});
        things_.splice(things_.begin(), things_, known);
        return std::static_pointer_cast<T>(things_.front().second);
    }

    std::size_t bytes() const {
        const std::lock_guard lock(mutex_);
        std::size_t sum = 0;
        for (const auto& [name, thing] : things_) sum += thing->bytes();
        return sum;
    }
    std::size_t max_bytes() const { return max_bytes_; }
    // To be asked between frames: down to this, and to the budget.
    void trim(std::size_t bytes);
    void trim() { trim(max_bytes_); }
    void clear() {
        const std::lock_guard lock(mutex_);
        things_.clear();
    }

private:
    const std::size_t max_bytes_;
    mutable std::mutex mutex_;
    std::list<std::pair<std::string, std::shared_ptr<Thing>>> things_;  // most recently used first
};

}  // namespace petzval::device
