#include "petzval/neighbours.h"

#include <algorithm>
#include <future>
#include <map>
#include <mutex>
#include <utility>

namespace petzval {
namespace {

using SharedShot = std::shared_ptr<const Result<Shot>>;

// The frames around one, the nearest first, of two as near the earlier.
std::vector<int> around(const std::vector<int>& frames, int frame, int each_side) {
    const auto next = std::upper_bound(frames.begin(), frames.end(), frame);
    const auto own = std::lower_bound(frames.begin(), frames.end(), frame);
    std::vector<int> found(own - std::min<std::ptrdiff_t>(each_side, own - frames.begin()), own);
    found.insert(found.end(), next, next + std::min<std::ptrdiff_t>(each_side, frames.end() - next));
    std::stable_sort(found.begin(), found.end(),
                     [&](int a, int b) { return std::abs(a - frame) < std::abs(b - frame); });
    return found;
}

}  // namespace

struct Neighbours::Kept {
    std::mutex mutex;
    std::map<int, std::shared_future<SharedShot>> shots;

    SharedShot get(int number, int around, std::size_t most, const Read& read) {
        std::promise<SharedShot> own;
        std::shared_future<SharedShot> wanted;
        {
            const std::lock_guard lock(mutex);
            const auto found = shots.find(number);
            if (found != shots.end()) {
                wanted = found->second;
            } else {
                while (shots.size() >= most) shots.erase(farthest_from(around));
                shots.emplace(number, own.get_future().share());
            }
        }
        if (wanted.valid()) return wanted.get();
        auto shot = std::make_shared<const Result<Shot>>(read(number));
        own.set_value(shot);
        return shot;
    }

private:
    std::map<int, std::shared_future<SharedShot>>::iterator farthest_from(int frame) {
        return std::max_element(shots.begin(), shots.end(), [&](const auto& a, const auto& b) {
            return std::abs(a.first - frame) < std::abs(b.first - frame);
        });
    }
};

Neighbours::Neighbours(std::vector<int> frames, int each_side, Read read)
    : kept_(std::make_unique<Kept>()),
      frames_(std::move(frames)),
      each_side_(each_side),
      read_(std::move(read)) {}

Neighbours::~Neighbours() = default;

Result<SeenElsewhere> Neighbours::behind(const Shot& shot, int frame, Workers& workers) {
    std::vector<SharedShot> held;
    std::vector<const Shot*> others;
    std::vector<std::string> left_out;
    for (const int other : around(frames_, frame, each_side_)) {
        held.push_back(kept_->get(other, frame, std::size_t(2 * each_side_ + 4), read_));
        const Result<Shot>& read = *held.back();
        if (read)
            others.push_back(&*read);
        else
            left_out.push_back(read.error().message);
    }
    auto found = seen_elsewhere(shot, others, workers);
    if (found) found->left_out.insert(found->left_out.begin(), left_out.begin(), left_out.end());
    return found;
}

}  // namespace petzval
