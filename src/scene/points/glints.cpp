// Sunlight glittering on water: where wave facets stand so that they mirror the sun into the lens.
//
// Slopes of the sea are normally distributed; their mean square is 0.003 + 0.00512 U for a wind of U m/s
// (C. Cox and W. Munk, "Measurement of the roughness of the sea surface from photographs of the sun's
// glitter", J. Opt. Soc. Am. 44, 1954; here the same along both axes). A facet is as bright as a curved
// mirror: its light falls as 1/distance^2 and goes with the square of its radius of curvature, which is
// taken as log-normal (an assumption), times the reflectance of water (Schlick's form of Fresnel's law).
#include "scene/points/point_sets.h"

#include <algorithm>

namespace petzval::scene {
namespace {

constexpr float kEyeHeight = 1.7f, kSunElevation = 0.21f, kWind = 4;  // m, rad, m/s
constexpr float kFarthest = 4000;                                     // m; beyond, glints melt together
constexpr float kSpread = 1.3f;                                       // standard deviation of ln(brightness)
constexpr float kBrightness = 9000;                                   // of a middling facet, from 1 m
constexpr Vec3 kSun{1, 0.86f, 0.62f};

struct Water {
    Vec3 at;
    float weight, reflectance;  // how many facets mirror the sun, per pixel; share of light they return
};

class Sea {
public:
    explicit Sea(const PointView& view) : view_(view) {}

    // The water that pixel position (x, y) shows; weight 0 where it shows none.
    Water at(float x, float y) const {
        const float below = (y - view_.horizon_px) / view_.focal_px,
                    right = (x - view_.centre_x) / view_.focal_px;
        if (below * kFarthest < kEyeHeight) return {};
        const float z = kEyeHeight / below;
        const Vec3 p{right * z, -kEyeHeight, z}, to_eye = normalised(-p);
        const Vec3 normal = normalised(to_eye + Vec3{0, std::sin(kSunElevation), std::cos(kSunElevation)});
        const float slope_x = normal.x / normal.y, slope_z = normal.z / normal.y;
        const float mean_square = 0.003f + 0.00512f * kWind;
        const float away = 1 - dot(normal, to_eye);
        return {p, std::exp(-(slope_x * slope_x + slope_z * slope_z) / mean_square),
                0.02f + 0.98f * away * away * away * away * away};
    }

private:
    const PointView& view_;
};

// Places in the picture, drawn in proportion to the weight of the cell they lie in.
class Cells {
public:
    Cells(const Sea& sea, const PointView& view)
        : wide_(float(view.width) / kSide), high_(float(view.height) / kSide) {
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                total_ += double(sea.at((float(i) + 0.5f) * wide_, (float(j) + 0.5f) * high_).weight);
                sums_.push_back(total_);
            }
    }
    bool empty() const { return total_ <= 0; }
    void draw(Dice& dice, float& x, float& y) const {
        const auto found = std::upper_bound(sums_.begin(), sums_.end(), double(dice.share()) * total_);
        const int cell = std::min(int(found - sums_.begin()), kSide * kSide - 1);
        const int column = cell % kSide, row = cell / kSide;
        x = (float(column) + dice.share()) * wide_, y = (float(row) + dice.share()) * high_;
    }

private:
    static constexpr int kSide = 256;
    float wide_, high_;
    double total_ = 0;
    std::vector<double> sums_;
};

// Normally distributed, by Box and Muller.
float normal(Dice& dice) {
    const float u = dice.share(), v = dice.share();
    return std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * kPi * v);
}

std::vector<LightPoint> make(const PointView& view, int count, std::uint64_t seed) {
    const Sea sea(view);
    const Cells cells(sea, view);
    std::vector<LightPoint> points;
    if (cells.empty()) return points;
    points.reserve(std::size_t(count));
    Dice dice(seed, 1);
    while (int(points.size()) < count) {
        float x = 0, y = 0;
        cells.draw(dice, x, y);
        const float brightness = kBrightness * std::exp(kSpread * normal(dice));
        const Water water = sea.at(x, y);
        if (water.at.z > 0) points.push_back(view.light(water.at, brightness * water.reflectance * kSun));
    }
    return points;
}

}  // namespace

PointSet glints() { return {{"glints", "sun glittering on water, out to the horizon", 2500, true}, make}; }

}  // namespace petzval::scene
