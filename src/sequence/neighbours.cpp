#include "petzval/neighbours.h"

#include <algorithm>
#include <future>
#include <map>
#include <mutex>
#include <utility>

namespace petzval {
namespace {

using SharedShot = std::shared_ptr<const Result<Shot>>;

std::size_t bytes_of(const Shot& shot) {
    std::size_t bytes = shot.colour.bytes() + shot.motion.to_next.bytes() + shot.motion.to_previous.bytes();
    const View<const float> depth = shot.depth_plane();
    bytes += std::size_t(depth.width()) * std::size_t(depth.height()) * sizeof(float);
    for (const DeepPicture* deep : {&shot.deep, &shot.behind, &shot.holdout}) bytes += deep->bytes();
    for (const FrameLayer& layer : shot.layers) bytes += layer.colour.bytes();
    return bytes;
}

}  // namespace

// The earlier of two equally near frames comes first.
std::vector<int> frames_around(std::span<const int> frames, int frame, int each_side) {
    const auto next = std::upper_bound(frames.begin(), frames.end(), frame);
    const auto own = std::lower_bound(frames.begin(), frames.end(), frame);
    std::vector<int> found(own - std::min<std::ptrdiff_t>(each_side, own - frames.begin()), own);
    found.insert(found.end(), next, next + std::min<std::ptrdiff_t>(each_side, frames.end() - next));
    std::stable_sort(found.begin(), found.end(),
                     [&](int a, int b) { return std::abs(a - frame) < std::abs(b - frame); });
    return found;
}

struct Neighbours::Kept {
    std::mutex mutex;
    std::map<int, std::size_t> bytes;
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
                while (shots.size() >= most) {
                    const auto farthest = farthest_from(around);
                    bytes.erase(farthest->first), shots.erase(farthest);
                }
                shots.emplace(number, own.get_future().share());
            }
        }
        if (wanted.valid()) return wanted.get();
        auto shot = std::make_shared<const Result<Shot>>(read(number));
        {
            const std::lock_guard lock(mutex);
            bytes[number] = *shot ? bytes_of(**shot) : 0;
        }
        own.set_value(shot);
        return shot;
    }

    std::size_t kept_bytes() {
        const std::lock_guard lock(mutex);
        std::size_t sum = 0;
        for (const auto& [number, of_shot] : bytes) sum += of_shot;
        return sum;
    }

private:
    std::map<int, std::shared_future<SharedShot>>::iterator farthest_from(int frame) {
        return std::max_element(shots.begin(), shots.end(), [&](const auto& a, const auto& b) {
            return std::abs(a.first - frame) < std::abs(b.first - frame);
        });
    }
};

Neighbours::Neighbours(std::vector<int> frames, int each_side, Read read, std::size_t max_memory_bytes,
                       MotionReading::From from)
    : kept_(std::make_unique<Kept>()),
      frames_(std::move(frames)),
      each_side_(each_side),
      read_(std::move(read)),
      max_memory_bytes_(max_memory_bytes),
      from_(from) {}

Neighbours::~Neighbours() = default;

Status Neighbours::check_memory(const Shot& shot) const {
    constexpr std::size_t kWorkPerPixel = 70;  // of seen_elsewhere()
    const std::size_t needed = bytes_of(shot) + kept_->kept_bytes() + kWorkPerPixel * shot.colour.size();
    if (max_memory_bytes_ == 0 || needed <= max_memory_bytes_) return Done{};
    return Error{ErrorCode::OutOfMemory,
                 "read.max_memory_bytes is too little: the frames around " + shot.path + " take more than " +
                     std::to_string((needed >> 20) + 1) +
                     "M together with it; use fewer neighbours or give more memory",
                 "read.max_memory_bytes"};
}

Result<SeenElsewhere> Neighbours::behind(const Shot& shot, int frame, Workers& workers,
                                         std::span<const Shot* const> eyes) {
    std::vector<SharedShot> held;
    std::vector<OtherPicture> others;
    for (const Shot* eye : eyes) others.push_back({eye});
    std::vector<std::string> left_out;
    for (const int other : frames_around(frames_, frame, each_side_)) {
        held.push_back(kept_->get(other, frame, std::size_t(2 * each_side_ + 1), read_));
        if (Status fits = check_memory(shot); !fits) return fits.error();
        const Result<Shot>& read = *held.back();
        if (read)
            others.push_back({&*read, other - frame, from_});
        else
            left_out.push_back(read.error().message);
    }
    auto found = seen_elsewhere(shot, others, workers);
    if (!found) return found;
    found->left_out.insert(found->left_out.begin(), left_out.begin(), left_out.end());
    found->kept_bytes = kept_->kept_bytes();
    return found;
}

}  // namespace petzval
