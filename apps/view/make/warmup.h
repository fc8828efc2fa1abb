// A device that has not drawn with an engine yet prepares its programs first: seconds, where a processor
// compiles them. Meanwhile others draw.
#pragma once

#include "petzval/defocus.h"
#include "petzval/look.h"
#include "petzval/session.h"

#include "maker.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace petzval::view {

class Warmup {
public:
    // `told` is called, by another thread, when an engine has become warm.
    Warmup(std::shared_ptr<Session> session, std::function<void()> told);
    ~Warmup();  // as soon as what is being prepared can be given up
    Warmup(const Warmup&) = delete;
    Warmup& operator=(const Warmup&) = delete;

    bool is_warm(const std::string& engine) const;
    // Draws a small picture of the wish with each look, in a separate thread; then the wish's engine is warm,
    // even if drawing failed. Does nothing while another engine is being prepared.
    void begin(const Wish& wish, std::vector<Look> looks);

private:
    void prepare(const Wish& wish, const std::vector<Look>& looks);

    std::shared_ptr<Session> session_;
    std::function<void()> told_;
    mutable std::mutex mutex_;
    std::set<std::string> warm_;
    bool busy_ = false;
    std::atomic<bool> ending_ = false;
    std::thread thread_;
};

}  // namespace petzval::view
