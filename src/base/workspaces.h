// Scratch memory of the workers of one loop: kept from piece to piece, gone when the loop ends.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace petzval {

template <typename Workspace>
class Workspaces {
public:
    // For one piece of work at a time.
    class Lease {
    public:
        Lease(Workspaces& from, std::unique_ptr<Workspace> own) : from_(from), own_(std::move(own)) {}
        ~Lease() { from_.give_back(std::move(own_)); }
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        Workspace& operator*() const { return *own_; }

    private:
        Workspaces& from_;
        std::unique_ptr<Workspace> own_;
    };
    Lease take() {
        {
            const std::lock_guard lock(mutex_);
            if (!free_.empty()) {
                std::unique_ptr<Workspace> own = std::move(free_.back());
                free_.pop_back();
                return {*this, std::move(own)};
            }
        }
        return {*this, std::make_unique<Workspace>()};
    }

private:
    void give_back(std::unique_ptr<Workspace> own) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(own));
    }
    std::mutex mutex_;
    std::vector<std::unique_ptr<Workspace>> free_;
};

}  // namespace petzval
