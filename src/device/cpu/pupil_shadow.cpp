#include "device/cpu/pupil_shadow.h"

#include <algorithm>
#include <cmath>

namespace petzval::device {
namespace {

// How much of each cell a box around `middle` covers, its edges blurred by another box: a trapezoid.
class Profile {
public:
    Profile(float middle, float side, float blur)
        : middle_(middle), outer_(0.5f * (side + blur)), inner_(0.5f * std::abs(side - blur)) {
        peak_ = blur > side ? side / blur : 1.0f;
        const float ramp = outer_ - inner_;
        per_ramp_ = ramp > 1e-6f ? 0.5f / ramp : 0.0f;
    }
    float begin() const { return middle_ - outer_; }
    float end() const { return middle_ + outer_; }
    // The shares of cells from `first` on.
    void shares(int first, std::span<float> out) const {
        float before = integral(float(first));
        for (std::size_t i = 0; i < out.size(); ++i) {
            const float after = integral(float(first + int(i) + 1));
            out[i] = after - before, before = after;
        }
    }

private:
    // Of the trapezoid from -outer to outer with its top from -inner to inner, up to x.
    float integral(float x) const {
        const float t = x - middle_, ramp = outer_ - inner_;
        const float up = std::clamp(t + outer_, 0.0f, ramp);
        const float flat = std::clamp(t + inner_, 0.0f, 2 * inner_);
        const float down = std::clamp(t - inner_, 0.0f, ramp);
        return peak_ * ((up * up - down * down) * per_ramp_ + flat + down);
    }
    float middle_, outer_, inner_, peak_, per_ramp_;
};

}  // namespace

PupilShadow::PupilShadow(const engine::ShadowGrid& grid)
    : scale_(grid.scale_px), taps_(grid.taps), parts_(grid.parts), covered_(taps_ * parts_, taps_ * parts_) {}

void PupilShadow::cover(float u, float v, float side, float blur, float coverage) {
    const float per_radius = scale_ * float(parts_), middle = 0.5f * float(covered_.width());
    const float cells = std::abs(per_radius);
    if (blur <= 0 && side * cells <= 1)
        return cover_few(middle + u * per_radius, middle + v * per_radius, side * cells, coverage);
    const Profile across(middle + u * per_radius, side * cells, blur * cells);
    const Profile down(middle + v * per_radius, side * cells, blur * cells);
    const auto limited = [&](float at) { return int(std::clamp(at, 0.0f, float(covered_.width()))); };
    const int left = limited(std::floor(across.begin())), right = limited(std::ceil(across.end()));
    const int top = limited(std::floor(down.begin())), bottom = limited(std::ceil(down.end()));
    constexpr int kChunk = 64;
    float wide[kChunk], tall[kChunk];
    for (int y0 = top; y0 < bottom; y0 += kChunk) {
        const auto rows = std::span(tall).first(std::size_t(std::min(kChunk, bottom - y0)));
        down.shares(y0, rows);
        for (int x0 = left; x0 < right; x0 += kChunk) {
            const auto columns = std::span(wide).first(std::size_t(std::min(kChunk, right - x0)));
            across.shares(x0, columns);
            for (std::size_t k = 0; k < rows.size(); ++k) {
                float* const row = covered_.row(y0 + int(k)) + x0;
                const float share = coverage * rows[k];
                for (std::size_t i = 0; i < columns.size(); ++i) row[i] += share * columns[i];
            }
        }
    }
}

// Most squares are no wider than a cell, and reach into one more at most.
void PupilShadow::cover_few(float x, float y, float side, float coverage) {
    const float left = x - 0.5f * side, top = y - 0.5f * side;
    const float column = std::floor(left), row = std::floor(top);
    const float in_first = std::min(side, column + 1 - left), in_top = std::min(side, row + 1 - top);
    const float wide[] = {in_first, side - in_first}, tall[] = {in_top, side - in_top};
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            if (const int cx = int(column) + i, cy = int(row) + j; covered_.rect().contains(cx, cy))
                covered_(cx, cy) += coverage * wide[i] * tall[j];
}

void PupilShadow::finish() {
    visible_ = Plane::uninitialised(taps_, taps_);
    for (int y = 0; y < taps_; ++y)
        for (int x = 0; x < taps_; ++x)
            visible_(x, y) =
                parts_ == 1 ? 1 - std::min(1.0f, covered_(x, y)) : visible(x * parts_, y * parts_);
    covered_ = {};
}

void PupilShadow::visible(int dx, int dy, std::span<float> shares) const {
    const float* const row = visible_.row(std::clamp(dy, 0, taps_ - 1));
    const auto n = std::ptrdiff_t(shares.size());
    const std::ptrdiff_t before = std::clamp<std::ptrdiff_t>(-dx, 0, n),
                         inside = std::clamp<std::ptrdiff_t>(taps_ - dx, before, n);
    std::fill(shares.begin(), shares.begin() + before, row[0]);
    if (inside > before) std::copy(row + dx + before, row + dx + inside, shares.begin() + before);
    std::fill(shares.begin() + inside, shares.end(), row[taps_ - 1]);
}

float PupilShadow::visible(int x0, int y0) const {
    float inside = 0, inside_count = 0, all = 0;
    for (int y = y0; y < y0 + parts_; ++y)
        for (int x = x0; x < x0 + parts_; ++x) {
            const float seen = 1 - std::min(1.0f, covered_(x, y));
            const float u = (float(x) + 0.5f - 0.5f * float(covered_.width())) / (scale_ * float(parts_));
            const float v = (float(y) + 0.5f - 0.5f * float(covered_.width())) / (scale_ * float(parts_));
            all += seen;
            if (u * u + v * v <= 1) inside += seen, inside_count += 1;
        }
    return inside_count > 0 ? inside / inside_count : all / float(parts_ * parts_);
}

}  // namespace petzval::device
