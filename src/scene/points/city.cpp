// A city at night from a height: streets with lamps and cars, blocks of houses with lit windows, nearer
// houses hiding what is behind them.
#include "scene/points/point_sets.h"

#include <algorithm>
#include <limits>

namespace petzval::scene {
namespace {

constexpr float kEyeHeight = 85, kNearest = 200, kFarthest = 6500, kBlock = 70;  // m

constexpr float kIntensity = 400;  // of 1 lumen: what a long exposure makes of it

constexpr Vec3 kSodium{1, 0.48f, 0.12f}, kLed{0.95f, 0.96f, 1}, kHead{0.92f, 0.95f, 1},
    kTail{1, 0.05f, 0.03f};
constexpr Vec3 kBeacon{1, 0.03f, 0.02f}, kBulb{1, 0.66f, 0.34f}, kTube{0.8f, 0.92f, 1};

struct House {
    Vec3 corner;  // left, on the ground, the wall towards the viewer
    float width, height;
};

class City {
public:
    City(const PointView& view, std::uint64_t seed)
        : view_(view),
          dice_(seed, 2),
          tops_(std::size_t(view.width), std::numeric_limits<float>::infinity()) {}

    std::vector<LightPoint> lights() {
        for (float z = kNearest; z < kFarthest; z += kBlock) add_row(z);
        return std::move(seen_);
    }

private:
    void add_row(float z) {
        const float half = 0.5f * float(view_.width) / view_.focal_px * (z + kBlock);
        for (float x = -std::ceil(half / kBlock) * kBlock; x < half; x += kBlock) {
            add_avenue(x, z);
            houses_.push_back({{x + 9, -kEyeHeight, z + 6}, dice_.between(16, 40), height_at(x, z)});
            add_windows(houses_.back());
        }
        add_cross_street(-half, half, z);
        for (const House& house : houses_) hide_behind(house);
        houses_.clear();
    }

    float height_at(float x, float z) {
        const float centre = std::exp(-(x * x + (z - 2200) * (z - 2200)) / (900.0f * 900.0f));
        const float tall = dice_.share();
        return 9 + 16 * dice_.share() + centre * 95 * tall * tall * tall;
    }

    // Away from the viewer: lamps on both sides, cars coming and going.
    void add_avenue(float x, float z) {
        for (const float side : {-6.5f, 6.5f})
            for (float along = 0; along < kBlock; along += kBlock / 3)
                shine({x + side, 8 - kEyeHeight, z + along}, 5200, dice_.share() < 0.7f ? kSodium : kLed);
        for (int car = 0; car < 2; ++car) {
            const bool coming = dice_.share() < 0.5f;
            const Vec3 at{x + (coming ? -2.2f : 2.2f), 0.7f - kEyeHeight, z + kBlock * dice_.share()};
            for (const float lamp : {-0.7f, 0.7f})
                shine(at + Vec3{lamp, 0, 0}, coming ? 6000 : 1500, coming ? kHead : kTail);
        }
    }

    void add_cross_street(float from, float to, float z) {
        for (float x = from; x < to; x += 24) shine({x, 7 - kEyeHeight, z}, 3600, kSodium);
    }

    void add_windows(const House& house) {
        const Vec3 usual = mix(kBulb, kTube, dice_.share() < 0.3f ? 0.9f : 0.1f);
        for (float up = 2; up < house.height - 1; up += 3.2f)
            for (float along = 1.5f; along < house.width; along += 3.4f) {
                if (dice_.share() > 0.3f) continue;
                const Vec3 colour = mix(usual, kBulb, dice_.share());
                shine(house.corner + Vec3{along, up, 0}, 1700 * dice_.between(0.2f, 1) * dice_.share(),
                      colour);
            }
        if (house.height > 60)
            shine(house.corner + Vec3{0.5f * house.width, house.height + 3, 0}, 4500, kBeacon);
    }

    void shine(Vec3 at, float intensity, Vec3 colour) {
        if (!view_.shows(at)) return;
        const LightPoint light = view_.light(at, kIntensity * intensity * dice_.between(0.7f, 1.3f) * colour);
        if (light.y < tops_[std::size_t(light.x)]) seen_.push_back(light);
    }

    // Farther ground lies higher in the picture, so a house hides all below its top that is behind it.
    void hide_behind(const House& house) {
        const float per_m = view_.focal_px / house.corner.z;
        const float left = view_.centre_x + per_m * house.corner.x;
        const float top = view_.horizon_px - per_m * (house.corner.y + house.height);
        const float right = std::min(left + per_m * house.width, float(view_.width));
        for (int x = int(std::max(0.0f, left)); float(x) < right; ++x)
            tops_[std::size_t(x)] = std::min(tops_[std::size_t(x)], top);
    }

    const PointView& view_;
    Dice dice_;
    std::vector<float> tops_;  // of the nearer houses, per column of pixels
    std::vector<House> houses_;
    std::vector<LightPoint> seen_;
};

std::vector<LightPoint> make(const PointView& view, int count, std::uint64_t seed) {
    std::vector<LightPoint> all = City(view, seed).lights();
    if (int(all.size()) <= count) return all;
    // Any `count` of them: the first of a shuffle (Fisher and Yates).
    Dice dice(seed, 3);
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        const double left = double(all.size() - i);
        std::swap(all[i], all[std::min(all.size() - 1, i + std::size_t(double(dice.share()) * left))]);
    }
    all.resize(std::size_t(count));
    return all;
}

}  // namespace

PointSet city() {
    return {{"city", "street lamps, cars and lit windows of a city at night, seen from a height", 6000, true},
            make};
}

}  // namespace petzval::scene
