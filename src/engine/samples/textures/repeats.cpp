#include "engine/samples/textures/repeats.h"

#include "engine/samples/completion_model.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kBeyond = 16;  // as many offsets are summed at once
constexpr float kUnknown = -1;

// Correlations by offset.
class Correlation {
public:
    explicit Correlation(const Details& piece) : farthest_(piece.farthest), pairs_(pairs_of(piece)) {
        most_ = at(0, 0).count;
        least_ = completion_model.texture_pairs * most_;
    }
    // kUnknown where too little is known, and beyond the farthest.
    float operator()(int x, int y) const {
        if (y < 0) x = -x, y = -y;
        if (y > farthest_ || std::abs(x) > farthest_) return kUnknown;
        const Pairs& p = at(x, y);
        return p.count < least_ ? kUnknown : p.alike();
    }
    // Number of pixels compared, and the mean square of their detail.
    float held() const { return most_; }
    float contrast() const { return 0.5f * at(0, 0).squares / std::max(1.0f, most_); }

private:
    const Pairs& at(int x, int y) const {
        return pairs_[std::size_t(y) * std::size_t(2 * farthest_ + 1) + std::size_t(x + farthest_)];
    }
    int farthest_;
    std::vector<Pairs> pairs_;
    float most_, least_;
};

// Position of the maximum of a parabola through three values, the middle one the largest: -1/2…1/2. Beside an
// unknown value it is the middle.
float peak(float before, float here, float after) {
    if (before == kUnknown || after == kUnknown) return 0;
    const float bend = before + after - 2 * here;
    return bend < -1e-6f ? std::clamp(0.5f * (before - after) / bend, -0.5f, 0.5f) : 0.0f;
}

// The highest peaks of correlation: of each direction and distance one, so that some of them lead out of any
// silhouette.
void find_repeats(const Correlation& alike, int farthest, Texture& texture) {
    constexpr int kLeastPx = 3, kSectors = 8;
    texture.repeats = {};
    for (int y = -farthest; y <= farthest; ++y)
        for (int x = -farthest; x <= farthest; ++x) {
            const int square = x * x + y * y;
            const float here = alike(x, y);
            if (square < kLeastPx * kLeastPx || here <= 0) continue;
            const float left = alike(x - 1, y), right = alike(x + 1, y), up = alike(x, y - 1),
                        down = alike(x, y + 1);
            if (here < std::max({left, right, up, down})) continue;
            const float turn = std::atan2(float(y), float(x)) / float(2 * M_PI) + 0.5f;
            const int ring = square < 8 * 8 ? 0 : square < 16 * 16 ? 1 : 2;
            const int sector = int(turn * float(kSectors)) % kSectors;
            Texture::Offset& best = texture.repeats[std::size_t(ring * kSectors + sector)];
            if (here > best.alike)
                best = {float(x) + peak(left, here, right), float(y) + peak(up, here, down), here};
        }
    std::stable_sort(texture.repeats.begin(), texture.repeats.end(),
                     [](const auto& a, const auto& b) { return a.alike > b.alike; });
}

// 1 up to `to`, 0 from twice that.
float within(double value, double to) { return float(std::clamp(2 - value / to, 0.0, 1.0)); }

// Grain is fine (blocks do not differ in their means), even (nor in their contrast), and neither of two tones
// nor of lone marks (its kurtosis is near that of a normal distribution).
float grain_of(const Details& piece) {
    constexpr int kBlock = 6, kLeastBlocks = 4;
    constexpr double kNormal = 3;  // kurtosis of a normal distribution
    const CompletionModel& model = completion_model;
    const int begin = piece.farthest, end = piece.farthest + piece.inner;
    double blocks = 0, means = 0, variances = 0, squares = 0, second = 0, fourth = 0;
    for (int by = begin; by + kBlock <= end; by += kBlock)
        for (int bx = begin; bx + kBlock <= end; bx += kBlock) {
            constexpr double kPixels = kBlock * kBlock;
            double sum = 0, sum2 = 0, sum4 = 0, known = 0;
            for (int y = by; y < by + kBlock; ++y)
                for (int x = bx; x < bx + kBlock; ++x) {
                    const double v = double(piece.values[piece.at(x, y)]);
                    known += double(piece.known[piece.at(x, y)]);
                    sum += v, sum2 += v * v, sum4 += v * v * v * v;
                }
            if (known < kPixels) continue;
            const double mean = sum / kPixels, variance = std::max(0.0, sum2 / kPixels - mean * mean);
            blocks += 1, means += mean * mean, variances += variance, squares += variance * variance;
            second += sum2, fourth += sum4;
        }
    if (blocks < kLeastBlocks || variances <= 0) return 0;
    const double kurtosis = fourth * blocks * kBlock * kBlock / (second * second);
    const double rough = means / (means + variances), uneven = blocks * squares / (variances * variances) - 1;
    return within(rough, double(model.grain_rough) / 100) *
           within(uneven, 2 * double(model.grain_rough) / 100) *
           within(kurtosis - kNormal - double(model.grain_kurtosis) + 1, 1) *
           float(std::clamp((kurtosis - kNormal + double(model.grain_kurtosis)) / 0.3, 0.0, 1.0));
}

}  // namespace

Details::Details(int inner_, int farthest_)
    : inner(inner_),
      farthest(farthest_),
      side(inner_ + 2 * farthest_),
      stride(side + kBeyond),
      values(std::size_t(stride) * std::size_t(side) + kBeyond),
      known(values.size()) {}

Texture texture_of(const Details& piece) {
    constexpr float kLeastHeld = 16;
    constexpr double kFlat = 1e-6;  // squared, relative: rounding alone shows so much contrast
    Texture texture{};
    const Correlation alike(piece);
    if (alike.held() < kLeastHeld || alike.contrast() < kFlat) return texture;
    find_repeats(alike, piece.farthest, texture);
    // A texture that repeats is not grain.
    texture.grain = std::clamp(5 * (completion_model.texture_least - texture.repeats[0].alike), 0.0f, 1.0f) *
                    grain_of(piece);
    return texture;
}

}  // namespace petzval::engine
