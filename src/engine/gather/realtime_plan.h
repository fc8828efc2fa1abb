// Input of the real-time pass (docs/explain/real-time.md): a lens's shape in front of focus and
// behind it, as a device's programs read it, and a picture.
#pragma once

#include "petzval/image.h"

#include "kernel/model/lens_model.h"

#include <array>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

namespace petzval::engine {

// Kernels of kSteps radii, pixel by pixel, each sqrt(2) times as large as the one before: first, of all in
// front of focus and then of all behind it, where each begins (its first four, pixels from the middle to the
// rim of its square, radius in pixels, 0); then their weights, which sum to 1.
struct LampKernels {
    static constexpr int kSteps = 14;
    static constexpr double kFirstPx = 0.5, kHalf = 1.25;  // pixels; radii that a square is half as wide as
    // All that the shape holds, and a rim of nothing.
    static constexpr int half_side(double radius_px) { return int(kHalf * radius_px) + 2; }
    static constexpr std::size_t weights() {
        std::size_t sum = 0;
        double radius_px = kFirstPx;
        for (int i = 0; i < kSteps; ++i, radius_px *= std::numbers::sqrt2) {
            const auto side = std::size_t(2 * half_side(radius_px) + 1);
            sum += side * side;
        }
        return sum;
    }
};

// Fours of floats, one after the other: taps over the unit disc (x, y, distance from the middle, 0); for
// shares of the disc's radius 0…1, what makes the taps of a plane of that radius sum to 1 (near, far, 0, 0);
// the shape in front of focus and behind it, kSide x kSide each over -kHalf…kHalf pupil radii, r, g, b and a:
// 1 is the mean over the unit disc. Then LampKernels.
struct RealtimeLens {
    static constexpr int kRings = 6, kTaps = 1 + 3 * kRings * (kRings + 1);
    static constexpr int kNorms = 64, kSide = 64;
    static constexpr float kHalf = float(LampKernels::kHalf);
    static constexpr std::size_t kFours = std::size_t(kTaps) + kNorms + 2 * std::size_t(kSide) * kSide +
                                          2 * (LampKernels::kSteps + LampKernels::weights());
    static constexpr std::size_t kBytes = kFours * sizeof(Rgba);
    std::vector<Rgba> fours;  // kFours
};

// The shapes that a lens has at these radii, in pixels, in one place of the field.
RealtimeLens realtime_lens(const kernel::LensModel& lens, kernel::FieldPosition field, double near_radius_px,
                           double far_radius_px);

struct RealtimePlan {
    View<const Rgba> colour;
    View<const float> coc_px;
    float most_px = 0;  // no radius is larger
    float pixel_aspect = 1;
    std::shared_ptr<const RealtimeLens> lens;
};

}  // namespace petzval::engine
