#include "shot/plate_doubt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace petzval::shot {
namespace {

constexpr float kOpaque = 0.98f;
constexpr float kSameDepth = 1.02f, kOtherDepth = 1.1f;  // ratios

bool look_alike(Rgba a, Rgba b) {
    constexpr float kLikeness = 0.25f, kDark = 0.02f;  // noise of renders stays below
    const auto near = [&](float p, float q) {
        return std::abs(p - q) <= kLikeness * std::max(std::abs(p), std::abs(q)) + kDark;
    };
    return near(a.r, b.r) && near(a.g, b.g) && near(a.b, b.b);
}

// Pixels that both show as opaque, at finite depths.
struct Compared {
    int all = 0, in_front = 0, behind = 0, same_depth = 0, same_depth_alike = 0;
    std::vector<float> alike;  // depths of the plate, in those of the picture, where colours are alike

    void add(Rgba seen, float depth_m, const DeepSample& plate) {
        const float ratio = plate.depth / depth_m;
        const bool is_alike = look_alike(seen, plate.colour);
        ++all;
        in_front += ratio < 1 / kOtherDepth;
        behind += ratio > kOtherDepth;
        if (ratio < kSameDepth && ratio > 1 / kSameDepth) {
            ++same_depth;
            same_depth_alike += is_alike;
        }
        if (is_alike) alike.push_back(ratio);
    }
};

Compared compared(const Shot& shot, View<const float> depth_m) {
    constexpr int kStep = 2;
    Compared found;
    for (int y = 0; y < depth_m.height(); y += kStep)
        for (int x = 0; x < depth_m.width(); x += kStep) {
            const auto samples = shot.behind.at(x, y);
            const float own = depth_m(x, y);
            if (samples.empty() || !(own > 0) || std::isinf(own) || shot.colour(x, y).a < kOpaque) continue;
            if (samples[0].colour.a < kOpaque || !(samples[0].depth > 0) || std::isinf(samples[0].depth))
                continue;
            found.add(shot.colour(x, y), own, samples[0]);
        }
    return found;
}

std::string sentence(const char* format, double number) {
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(), format, number);
    return text.data();
}

}  // namespace

std::string plate_doubt(const Shot& shot, View<const float> depth_m) {
    constexpr int kEnough = 100;  // pixels
    constexpr double kMany = 0.1, kMost = 0.5, kFew = 0.3;
    Compared found = compared(shot, depth_m);
    const double all = found.all, alike = double(found.alike.size());
    if (found.all < kEnough) return "";
    if (found.same_depth < kMany * all && alike > kMost * all) {
        std::sort(found.alike.begin(), found.alike.end());
        const auto at = [&](double share) { return found.alike[std::size_t(share * (alike - 1))]; };
        if (at(0.9) < kSameDepth * at(0.1))
            return sentence("plate: has the picture's colours at %.3g times its depth; is its unit another?",
                            at(0.5));
    }
    if (found.in_front > kMany * all)
        return sentence("plate: %.0f %% of it lies in front of the picture; are the two files swapped?",
                        100 * found.in_front / all);
    if (found.same_depth > kMany * all && found.same_depth_alike < kFew * found.same_depth)
        return sentence(
            "plate: only %.0f %% of the surfaces that the picture shows too have its colour; is it of "
            "another frame or exposure?",
            100.0 * found.same_depth_alike / found.same_depth);
    if (found.behind == 0 && found.same_depth > kMost * all) return "plate: shows nothing behind the picture";
    return "";
}

}  // namespace petzval::shot
