#include "engine/shadow_casters.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kOpaque = 0.98f;

// The samples of one rank (0: nearest of its pixel) in a block, merged.
class BlockCasters {
public:
    BlockCasters(CocSamplesView samples, const Rect& block, std::vector<Caster>& out)
        : samples_(samples), block_(block), out_(out) {}

    // False: no pixel of the block has a sample of this rank.
    bool add(std::size_t rank) {
        rank_ = rank;
        return add_square(block_.x0, block_.y0, ShadowCasters::kBlock);
    }

private:
    const CocSample* at(int x, int y) const {
        const auto all = samples_.at(x, y);
        return rank_ < all.size() ? &all[rank_] : nullptr;
    }
    bool add_square(int x0, int y0, int size) {
        const Rect r = Rect{x0, y0, x0 + size, y0 + size}.intersected(block_);
        if (r.empty()) return false;
        bool any = false, whole = r.width() == size && r.height() == size;
        float low = 1e30f, high = -1e30f;
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) {
                const CocSample* s = at(x, y);
                any = any || s;
                whole = whole && s && s->colour.a >= kOpaque;
                if (s) low = std::min(low, s->coc_px), high = std::max(high, s->coc_px);
            }
        if (!any) return false;
        if (size == 1) {
            const CocSample& s = *at(x0, y0);
            if (s.colour.a > 0) out_.push_back({float(x0), float(y0), 1, s.coc_px, s.colour.a});
        } else if (whole && high - low <= ShadowCasters::kSameRadiusPx) {
            const float middle = 0.5f * float(size - 1);
            out_.push_back({float(x0) + middle, float(y0) + middle, float(size), 0.5f * (low + high), 1});
        } else {
            for (const int dy : {0, size / 2})
                for (const int dx : {0, size / 2}) add_square(x0 + dx, y0 + dy, size / 2);
        }
        return true;
    }

    CocSamplesView samples_;
    Rect block_;
    std::vector<Caster>& out_;
    std::size_t rank_ = 0;
};

}  // namespace

ShadowCasters::ShadowCasters(const CocSamples& samples, int threads)
    : nearest_of_blocks_((samples.width + kBlock - 1) / kBlock, (samples.height() + kBlock - 1) / kBlock,
                         1e30f),
      rows_(std::size_t(nearest_of_blocks_.height())),
      first_(rows_.size()) {
    const CocSamplesView view = samples;
    const Rect picture{0, 0, samples.width, samples.height()};
    parallel_for(nearest_of_blocks_.height(), threads, [&](int by) {
        std::vector<Caster>& row = rows_[std::size_t(by)];
        std::vector<std::size_t>& first = first_[std::size_t(by)];
        first.push_back(0);
        for (int bx = 0; bx < nearest_of_blocks_.width(); ++bx) {
            const Rect block =
                Rect{bx * kBlock, by * kBlock, (bx + 1) * kBlock, (by + 1) * kBlock}.intersected(picture);
            BlockCasters casters(view, block, row);
            for (std::size_t rank = 0; casters.add(rank);) ++rank;
            std::stable_sort(row.begin() + std::ptrdiff_t(first.back()), row.end(),
                             [](const Caster& a, const Caster& b) { return a.coc_px < b.coc_px; });
            if (row.size() > first.back()) nearest_of_blocks_(bx, by) = row[first.back()].coc_px;
            first.push_back(row.size());
        }
    });
    for (std::size_t i = 0; i < nearest_of_blocks_.size(); ++i)
        nearest_ = std::min(nearest_, nearest_of_blocks_.pixels()[i]);
}

std::span<const Caster> ShadowCasters::of_block(int bx, int by) const {
    const auto& first = first_[std::size_t(by)];
    const std::size_t begin = first[std::size_t(bx)], end = first[std::size_t(bx) + 1];
    return std::span(rows_[std::size_t(by)]).subspan(begin, end - begin);
}

}  // namespace petzval::engine
