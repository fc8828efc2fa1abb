#include "branch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace petzval::bench {
namespace {

constexpr int kWidth = 640, kHeight = 480, kFiner = 4;
constexpr float kBranchM = 1.49f, kFocusM = 3, kHalfWidth = 15;  // m, m, px

std::uint32_t mixed(std::uint32_t x) {
    x ^= x >> 16, x *= 0x7feb352du;
    x ^= x >> 15, x *= 0x846ca68bu;
    return x ^ x >> 16;
}

// Every row has its own colour, so the hidden part of a row can be inferred from the visible part.
Rgba bricks(float x, float y) {
    const int row = int(std::floor(y / 11));
    const float at = x + float(row % 2) * 9;
    if (at - 18 * std::floor(at / 18) < 1.6f || y - 11 * float(row) < 1.6f) return {0.03f, 0.07f, 0.11f, 1};
    const auto shade = [&](std::uint32_t channel, float tint) {
        return tint * (0.06f + 0.10f * float(mixed(std::uint32_t(row) * 37 + channel) >> 8) * 0x1p-24f);
    };
    return {shade(1, 1.0f), shade(2, 1.1f), shade(3, 1.3f), 1};
}

bool in_box(float x, float y) { return x < 330 && y > 90; }

Rgba behind(float x, float y) {
    if (in_box(x, y)) return bricks(x, y);
    return y > 230 ? Rgba{0.012f, 0.012f, 0.014f, 1} : Rgba{0.02f, 0.02f, 0.03f, 1};
}

struct Branch {
    explicit Branch(double tilt_deg)
        : across(float(std::cos(tilt_deg * 3.14159265358979 / 180))),
          along(float(std::sin(tilt_deg * 3.14159265358979 / 180))) {}
    float off(float x, float y) const { return (x - 350) * across + (y - 200) * along; }
    // Premultiplied by its coverage.
    Rgba at(float x, float y) const {
        const float d = off(x, y), lit = (d + 4) / 15;
        if (std::abs(d) >= kHalfWidth) return {};
        const float light = std::clamp(1 - lit * lit, 0.1f, 1.0f);
        return {light * 0.06f, light * 0.045f, light * 0.03f, 1};
    }
    float across, along;
};

// The mean over a pixel's square.
template <typename Colour>
Rgba in_pixel(int x, int y, const Colour& colour) {
    Rgba sum;
    for (int j = 0; j < kFiner; ++j)
        for (int i = 0; i < kFiner; ++i)
            sum = sum + colour(float(x) + (float(i) + 0.5f) / kFiner, float(y) + (float(j) + 0.5f) / kFiner);
    return (1.0f / (kFiner * kFiner)) * sum;
}

// The branch's light and coverage, each pixel spread over a disc; beyond the frame it continues.
Picture blurred(const Branch& branch, float radius_px) {
    Picture sum(kWidth, kHeight);
    const int n = int(std::ceil(radius_px)) + 1;
    std::vector<float> kernel;
    float total = 0;
    for (int dy = -n; dy <= n; ++dy)
        for (int dx = -n; dx <= n; ++dx) {
            kernel.push_back(std::clamp(radius_px + 0.5f - std::hypot(float(dx), float(dy)), 0.0f, 1.0f));
            total += kernel.back();
        }
    for (int y = -n; y < kHeight + n; ++y)
        for (int x = -n; x < kWidth + n; ++x) {
            const Rgba light = in_pixel(x, y, [&](float u, float v) { return branch.at(u, v); });
            if (light.a == 0) continue;
            for (int v = std::max(0, y - n); v <= std::min(kHeight - 1, y + n); ++v)
                for (int u = std::max(0, x - n); u <= std::min(kWidth - 1, x + n); ++u)
                    sum(u, v) = sum(u, v) +
                                kernel[std::size_t((v - y + n) * (2 * n + 1) + u - x + n)] / total * light;
        }
    return sum;
}

float depth_at(const Branch& branch, int x, int y) {
    const float u = float(x) + 0.625f, v = float(y) + 0.625f;  // the sample right of and below the middle
    if (std::abs(branch.off(u, v)) < kHalfWidth) return kBranchM;
    if (in_box(u, v)) return kFocusM;
    return std::clamp(3.65f * 290 / std::max(v - 190, 1e-3f), 3.65f, 14.0f);
}

}  // namespace

CompletionShot branch_shot(double tilt_deg, double f_number) {
    const Branch branch(tilt_deg);
    Still still{{},
                Picture(kWidth, kHeight),
                Picture(kWidth, kHeight),
                Plane(kWidth, kHeight),
                Image<unsigned char>(kWidth, kHeight),
                {85, 36, f_number, kFocusM},
                {},
                {}};
    const double f = 85, radius_mm = 0.5 * f * f / f_number * (kFocusM - kBranchM) /
                                     (kBranchM * (kFocusM * 1000 - f));
    const Picture near = blurred(branch, float(radius_mm * kWidth / 36));
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const Rgba back = in_pixel(x, y, behind);
            const Rgba front = in_pixel(x, y, [&](float u, float v) { return branch.at(u, v); });
            still.sharp(x, y) = front + (1 - front.a) * back;
            still.truth(x, y) = near(x, y) + (1 - near(x, y).a) * back;
            still.depth_m(x, y) = depth_at(branch, x, y);
            still.counts(x, y) =
                std::abs(branch.off(float(x) + 0.5f, float(y) + 0.5f)) < 40 && x < 332 && y > 120 && y < 440;
        }
    CompletionShot shot;
    shot.exposure = 5;
    shot.frames.push_back(std::move(still));
    return shot;
}

}  // namespace petzval::bench
