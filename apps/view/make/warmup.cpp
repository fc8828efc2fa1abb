#include "warmup.h"

#include "thinning.h"

#include <algorithm>
#include <new>
#include <utility>

namespace petzval::view {

Warmup::Warmup(std::shared_ptr<Session> session, std::function<void()> told)
    : session_(std::move(session)), told_(std::move(told)) {}

Warmup::~Warmup() {
    ending_ = true;
    if (thread_.joinable()) thread_.join();
}

bool Warmup::is_warm(const std::string& engine) const {
    const std::lock_guard lock(mutex_);
    return warm_.contains(engine);
}

void Warmup::begin(const Wish& wish, std::vector<Look> looks) {
    const std::lock_guard lock(mutex_);
    if (busy_) return;
    if (thread_.joinable()) thread_.join();
    busy_ = true;
    thread_ = std::thread([this, wish, all = std::move(looks)] {
        try {
            prepare(wish, all);
        } catch (const std::bad_alloc&) {  // the frame itself will say so
        }
        {
            const std::lock_guard done(mutex_);
            warm_.insert(wish.look.engine);
        }
        told_();
        const std::lock_guard done(mutex_);
        busy_ = false;  // last: who waits for this thread may be whom it tells
    });
}

void Warmup::prepare(const Wish& wish, const std::vector<Look>& looks) {
    constexpr int kWidth_px = 128;
    const auto all = rendered(wish.shot->shot);
    if (!all) return;
    const int by = std::max(1, all->colour.width() / kWidth_px);
    const Picture colour = thinned(all->colour, by);
    const Plane depth = thinned(depth_or_radii(*all), by);
    Rendered few;
    few.camera = wish.camera;
    few.colour = colour;
    few.depth = all->depth;
    set_depth(few, depth);
    few.place = Place::whole(colour.rect());
    for (const Look& look : looks)
        static_cast<void>(session_->take(few, look, {.cancelled = [this] { return ending_.load(); }}));
}

// The part of the maker that asks if a device is warm.

// Engine realtime is a device's alone.
bool Maker::is_cold(const Wish& wish) const {
    return warmup_ && !device_is_lost_ && !wish.on_cpu && wish.shown == "result" &&
           wish.look.engine != "realtime" && !warmup_->is_warm(wish.look.engine);
}

bool Maker::can_be_made(const std::optional<Order>& order) const {
    return order && (order->step == 0 || !is_cold(order->wish));
}

}  // namespace petzval::view
