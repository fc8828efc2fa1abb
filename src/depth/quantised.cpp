#include "depth/quantised.h"

#include "petzval/depth.h"

#include "base/bits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_set>
#include <vector>

namespace petzval {
namespace {

constexpr float kFar = 1e9f;
constexpr float kNoValueFrom = 1e10f;

// All values that there are, ascending; empty: more than a file's codes.
std::vector<float> distinct_values(View<const float> values) {
    constexpr std::size_t kMost = 65536, kSome = 4096;
    constexpr float kHardlyTwice = 0.9f;      // of some values so many distinct ones are not codes
    std::unordered_set<std::uint32_t> found;  // as bits: numbers hash slowly
    std::size_t seen = 0;
    for (int y = 0; y < values.height(); ++y)
        for (int x = 0; x < values.width(); ++x) {
            const float v = values(x, y);
            if (!std::isfinite(v) || std::abs(v) >= kNoValueFrom) continue;
            found.insert(bits_as<std::uint32_t>(v + 0.0f)), ++seen;  // (-0 + 0 is 0)
            if (found.size() > kMost || (seen == kSome && float(found.size()) > kHardlyTwice * kSome))
                return {};
        }
    std::vector<float> sorted;
    for (const std::uint32_t bits : found) sorted.push_back(bits_as<float>(bits));
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

// Distances to the nearest pixels one code lower and one higher, within plateaus, by two sweeps over the
// picture (chamfer, G. Borgefors 1986).
class Plateaus {
public:
    Plateaus(View<const float> values, float quantum, bool (*has_value)(float))
        : values_(values), quantum_(quantum), has_value_(has_value) {
        for (Side* side : {&lower_, &higher_}) {
            side->distance = Plane(values.width(), values.height(), kFar);
            side->beyond = Image<int>(values.width(), values.height(), -1);
        }
        for (int y = 0; y < values.height(); ++y)
            for (int x = 0; x < values.width(); ++x) relax(x, y, 1);
        for (int y = values.height() - 1; y >= 0; --y)
            for (int x = values.width() - 1; x >= 0; --x) relax(x, y, -1);
    }

    float joined(int x, int y) const {
        const float v = values_(x, y), half = 0.5f * quantum_;
        if (!has_value_(v)) return v;
        const float to_lower = lower_.distance(x, y) - 0.5f, to_higher = higher_.distance(x, y) - 0.5f;
        if (lower_.knows(x, y) && higher_.knows(x, y))
            return v + half * (to_lower - to_higher) / (to_lower + to_higher);
        // A plateau that ends on one side alone slopes like the next one, as far as it keeps its code.
        if (higher_.knows(x, y)) return v + half * slope_from(higher_, x, y, to_higher);
        if (lower_.knows(x, y)) return v - half * slope_from(lower_, x, y, to_lower);
        return v;
    }

private:
    struct Side {
        Plane distance;
        Image<int> beyond;  // the pixel of the other plateau that is nearest
        bool knows(int x, int y) const { return distance(x, y) < kFar; }
    };

    // In quanta; 0 where values are no code apart.
    int codes_between(float from, float to) const {
        if (!has_value_(from) || !has_value_(to)) return std::numeric_limits<int>::max();
        const float codes = (to - from) / quantum_;
        return std::abs(codes) > 2 ? 2 : int(std::lround(codes));
    }
    void relax(int x, int y, int sense) {
        constexpr float kSide = 1, kDiagonal = 1.41421356f;
        // Steps to plateaus lie on any side, the first sweep finds them all.
        for (int dy = -1; dy <= (sense > 0 ? 1 : 0); ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const int u = x + sense * dx, v = y + sense * dy;
                if ((dx == 0 && dy == 0) || !values_.rect().contains(u, v)) continue;
                const float step = dx != 0 && dy != 0 ? kDiagonal : kSide;
                const int codes = codes_between(values_(x, y), values_(u, v));
                if (codes == 1 || codes == -1) {
                    take(codes == 1 ? higher_ : lower_, x, y, step, v * values_.width() + u);
                } else if (codes == 0) {
                    for (Side* side : {&lower_, &higher_})
                        take(*side, x, y, side->distance(u, v) + step, side->beyond(u, v));
                }
            }
    }
    static void take(Side& side, int x, int y, float distance, int beyond) {
        if (distance < side.distance(x, y)) side.distance(x, y) = distance, side.beyond(x, y) = beyond;
    }
    // The share of half a quantum that the surface has risen, so far from the step to the plateau on that
    // side.
    float slope_from(const Side& side, int x, int y, float distance) const {
        const int u = side.beyond(x, y) % values_.width(), v = side.beyond(x, y) / values_.width();
        if (!lower_.knows(u, v) || !higher_.knows(u, v)) return 0;
        const float width = lower_.distance(u, v) + higher_.distance(u, v) - 1;
        return std::max(0.0f, 1 - 2 * distance / width);
    }

    View<const float> values_;
    float quantum_;
    bool (*has_value_)(float);
    Side lower_, higher_;
};

}  // namespace

float quantum_of(View<const float> values, bool are_codes) {
    const std::vector<float> sorted = distinct_values(values);
    // Things at a few depths, drawn by hand or rendered, may lie evenly too.
    const std::size_t least = are_codes ? 3 : 48;
    if (sorted.size() < least) return 0;
    std::vector<float> gaps;
    for (std::size_t i = 1; i < sorted.size(); ++i) gaps.push_back(sorted[i] - sorted[i - 1]);
    const float smallest = *std::min_element(gaps.begin(), gaps.end());
    // The mean of all gaps of one code, as what was computed with codes is rounded.
    float sum = 0;
    std::size_t single = 0;
    for (const float gap : gaps)
        if (gap < 1.5f * smallest) sum += gap, ++single;
    const float quantum = sum / float(single);
    constexpr float kRounded = 0.05f, kMostlyNext = 0.5f;
    const bool even = std::all_of(gaps.begin(), gaps.end(), [&](float gap) {
        const float codes = gap / quantum;
        return std::abs(codes - std::round(codes)) <= kRounded * std::max(1.0f, 0.1f * codes);
    });
    return even && float(single) >= kMostlyNext * float(gaps.size()) ? quantum : 0;
}

Plane without_steps(View<const float> values, float quantum, bool (*has_value)(float)) {
    const Plateaus plateaus(values, quantum, has_value);
    Plane joined = Plane::uninitialised(values.width(), values.height());
    for (int y = 0; y < values.height(); ++y)
        for (int x = 0; x < values.width(); ++x) joined(x, y) = plateaus.joined(x, y);
    return joined;
}

float join_depth_codes(Plane& depth, const DepthSettings& settings, bool are_codes) {
    const float quantum = depth.empty() ? 0 : quantum_of(depth, are_codes);
    if (!(quantum > 0)) return 0;
    // A depth of 0 is missing, unless it is the end of a range.
    const bool any = settings.kind == DepthKind::CocPx || (settings.range_near && settings.range_far);
    depth = without_steps(
        depth, quantum, any ? [](float v) { return std::isfinite(v); } : [](float v) {
            return std::isfinite(v) && v != 0 && std::abs(v) < kNoValueFrom;
        });
    return quantum;
}

}  // namespace petzval
