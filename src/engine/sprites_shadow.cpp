#include "engine/sprites_shadow.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kBlock = 16;
constexpr float kOwnSurfacePx = 1;     // what is nearer by less is the light's own surface
constexpr float kWidestPupil = 1.25f;  // from the middle to a corner of the grid, pupil radii
constexpr float kStepPx = 1.5f;        // along a ray's way over the picture

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
    : in_(input), blocks_((input.width() + kBlock - 1) / kBlock, (input.height() + kBlock - 1) / kBlock) {
    parallel_for(blocks_.height(), input.threads, [&](int by) {
        for (int y = by * kBlock; y < std::min(input.height(), (by + 1) * kBlock); ++y)
            for (int x = 0; x < input.width(); ++x) {
                Block& block = blocks_(x / kBlock, by);
                block.nearest = std::min(block.nearest, input.coc_px(x, y));
                block.farthest = std::max(block.farthest, input.coc_px(x, y));
            }
    });
}

// A block is in the way if it holds something nearer than the light and rays can have come as far as it lies
// by the radius it has.
SpriteShadows::Blockers SpriteShadows::blockers(float x, float y, float coc_px) const {
    const float limit = coc_px - kOwnSurfacePx;
    Blockers found;
    if (in_.nearest_coc_px >= limit) return found;
    const float widest = kWidestPupil * std::max(1.0f, float(in_.pixel_aspect));
    const float reach = (coc_px - in_.nearest_coc_px) * widest;
    const auto block = [](float at, int count) {
        return std::clamp(int(std::floor(at / kBlock)), 0, count - 1);
    };
    const auto gap = [](float at, int cell) {
        const float begin = float(cell * kBlock);
        return std::max({0.0f, begin - at, at - (begin + kBlock)});
    };
    const int x0 = block(x - reach, blocks_.width()), x1 = block(x + reach, blocks_.width());
    const int y0 = block(y - reach, blocks_.height()), y1 = block(y + reach, blocks_.height());
    for (int by = y0; by <= y1; ++by)
        for (int bx = x0; bx <= x1; ++bx) {
            const Block& b = blocks_(bx, by);
            if (b.nearest >= limit) continue;
            const float dx = gap(x, bx), dy = gap(y, by), far = (coc_px - b.nearest) * widest;
            if (dx * dx + dy * dy > far * far) continue;
            found.nearest = std::min(found.nearest, b.nearest);
            found.farthest = std::max(found.farthest, std::min(b.farthest, limit));
        }
    return found;
}

bool SpriteShadows::is_stopped(float x, float y, float coc_px, float u, float v,
                               const Blockers& blockers) const {
    // How far the ray has come, in radius, where it can first and last meet something.
    const float first = coc_px - blockers.farthest, way = blockers.farthest - blockers.nearest;
    const int steps = 1 + int(std::min(way * std::sqrt(u * u + v * v) / kStepPx, 4096.0f));
    const float step = way / float(steps), tolerance = 0.5f * step + 0.25f;
    for (int k = 0; k <= steps; ++k) {
        const float passed = first + step * float(k);
        const int qx = int(std::floor(x + passed * u)), qy = int(std::floor(y + passed * v));
        if (!in_.coc_px.rect().contains(qx, qy)) return false;
        const float there = in_.coc_px(qx, qy);
        if (there < coc_px - kOwnSurfacePx && std::abs(there - (coc_px - passed)) <= tolerance) return true;
    }
    return false;
}

PupilMask SpriteShadows::mask(float x, float y, float coc_px) const {
    PupilMask mask;
    const Blockers in_the_way = blockers(x, y, coc_px);
    if (in_the_way.none()) return mask;
    const float aspect = float(in_.pixel_aspect);
    const auto middle = [](int k) { return (2 * float(k) + 1) / PupilMask::kSide - 1; };
    for (int j = 0; j < PupilMask::kSide; ++j)
        for (int i = 0; i < PupilMask::kSide; ++i)
            if (is_stopped(x, y, coc_px, middle(i), middle(j) * aspect, in_the_way))
                mask.seen &= ~(std::uint64_t(1) << (j * PupilMask::kSide + i));
    return mask;
}

}  // namespace petzval::engine
