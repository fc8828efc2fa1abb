#include "engine/sprites_shadow.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kBlock = 16;
constexpr float kOwnSurfacePx = 1;  // what is nearer by less is the light's own surface
constexpr float kStepPx = 1.5f;     // along a ray's way over the picture

// The two grid points around a place of the pupil's square.
struct Between {
    int cell;
    float share;  // of the second
    explicit Between(float t) {
        const float p = std::clamp((t + 1) / 2 * PupilMask::kSide - 0.5f, 0.0f, float(PupilMask::kSide - 1));
        cell = std::min(int(p), PupilMask::kSide - 2);
        share = p - float(cell);
    }
};

}  // namespace

std::array<float, PupilMask::kSide> PupilMask::row(float y) const {
    const Between b(y);
    std::array<float, kSide> values;
    for (int i = 0; i < kSide; ++i) {
        const auto share = [&](int line) { return float(seen >> (line * kSide + i) & 1); };
        values[std::size_t(i)] = share(b.cell) + b.share * (share(b.cell + 1) - share(b.cell));
    }
    return values;
}

float PupilMask::at(const std::array<float, kSide>& row, float x) {
    const Between b(x);
    const float left = row[std::size_t(b.cell)];
    return left + b.share * (row[std::size_t(b.cell + 1)] - left);
}

SpriteShadows::SpriteShadows(const Input& input)
    : in_(input),
      nearest_((input.width() + kBlock - 1) / kBlock, (input.height() + kBlock - 1) / kBlock, 1e30f) {
    parallel_for(nearest_.height(), input.threads, [&](int by) {
        for (int y = by * kBlock; y < std::min(input.height(), (by + 1) * kBlock); ++y)
            for (int x = 0; x < input.width(); ++x)
                nearest_(x / kBlock, by) = std::min(nearest_(x / kBlock, by), input.coc_px(x, y));
    });
}

// Nothing nearer stands anywhere that a ray could pass.
bool SpriteShadows::is_clear(float x, float y, float coc_px) const {
    const float limit = coc_px - kOwnSurfacePx;
    if (in_.nearest_coc_px >= limit) return true;
    const float reach = (coc_px - in_.nearest_coc_px) * std::max(1.0f, float(in_.pixel_aspect));
    const auto block = [](float at, int blocks) {
        return std::clamp(int(std::floor(at / kBlock)), 0, blocks - 1);
    };
    const int x0 = block(x - reach, nearest_.width()), x1 = block(x + reach, nearest_.width());
    const int y0 = block(y - reach, nearest_.height()), y1 = block(y + reach, nearest_.height());
    for (int by = y0; by <= y1; ++by)
        for (int bx = x0; bx <= x1; ++bx)
            if (nearest_(bx, by) < limit) return false;
    return true;
}

bool SpriteShadows::is_stopped(float x, float y, float coc_px, float u, float v) const {
    const float way = (coc_px - in_.nearest_coc_px) * std::hypot(u, v);
    const int steps = 1 + int(std::min(way / kStepPx, 4096.0f));
    const float step = (coc_px - in_.nearest_coc_px) / float(steps);
    for (int k = 0; k <= steps; ++k) {
        const float passed = step * float(k), at = coc_px - passed;
        const int qx = int(std::floor(x + passed * u)), qy = int(std::floor(y + passed * v));
        if (!in_.coc_px.rect().contains(qx, qy)) return false;
        const float there = in_.coc_px(qx, qy);
        if (there < coc_px - kOwnSurfacePx && std::abs(there - at) <= 0.5f * step + 0.25f) return true;
    }
    return false;
}

PupilMask SpriteShadows::mask(float x, float y, float coc_px) const {
    PupilMask mask;
    if (is_clear(x, y, coc_px)) return mask;
    const float aspect = float(in_.pixel_aspect);
    for (int j = 0; j < PupilMask::kSide; ++j)
        for (int i = 0; i < PupilMask::kSide; ++i) {
            const auto middle = [](int k) { return (2 * float(k) + 1) / PupilMask::kSide - 1; };
            if (!is_stopped(x, y, coc_px, middle(i), middle(j) * aspect)) continue;
            mask.seen &= ~(std::uint64_t(1) << (j * PupilMask::kSide + i));
        }
    return mask;
}

}  // namespace petzval::engine
