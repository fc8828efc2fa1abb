#include "engine/lights/shadow_casters.h"

#include "base/parallel.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace petzval::engine {
namespace {

// The samples of one rank (0: nearest of its pixel) in a block, merged.
class BlockCasters {
public:
    // `samples` are the block's rows.
    BlockCasters(CocSamplesView samples, const Rect& block, std::vector<Caster>& out)
        : samples_(samples), block_(block), out_(out) {}

    // Largest number of samples in a pixel of the block.
    std::size_t ranks() const {
        std::size_t most = 0;
        for (int y = block_.y0; y < block_.y1; ++y)
            for (int x = block_.x0; x < block_.x1; ++x)
                most = std::max(most, samples_.at(x, y - block_.y0).size());
        return most;
    }
    void add(std::size_t rank) {
        rank_ = rank;
        add_square(block_.x0, block_.y0, ShadowCasters::kBlock);
    }

private:
    const CocSample* at(int x, int y) const {
        const auto all = samples_.at(x, y - block_.y0);
        return rank_ < all.size() ? &all[rank_] : nullptr;
    }
    void add_square(int x0, int y0, int size) {
        const Rect r = Rect{x0, y0, x0 + size, y0 + size}.intersected(block_);
        if (r.empty()) return;
        bool any = false, whole = r.width() == size && r.height() == size;
        float low = 1e30f, high = -1e30f;
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) {
                const CocSample* s = at(x, y);
                any = any || s;
                whole = whole && s && s->colour.a >= laws::kOpaqueCaster;
                if (s) low = std::min(low, s->coc_px), high = std::max(high, s->coc_px);
            }
        if (!any) return;
        if (size == 1) {
            const CocSample& s = *at(x0, y0);
            if (s.colour.a > 0)
                out_.push_back({float(x0), float(y0), 1, s.coc_px, s.colour.a, slope(x0, y0, 1, 0),
                                slope(x0, y0, 0, 1)});
        } else if (whole && laws::same_surface(laws::kOneSquare, low, high)) {
            const float middle = 0.5f * float(size - 1);
            const int last = size - 1, x1 = x0 + last, y1 = y0 + last;
            const auto coc = [&](int x, int y) { return at(x, y)->coc_px; };
            const float falling = (coc(x1, y1) - coc(x0, y0)) / float(2 * last),
                        rising = (coc(x1, y0) - coc(x0, y1)) / float(2 * last);
            out_.push_back({float(x0) + middle, float(y0) + middle, float(size), 0.5f * (low + high), 1,
                            falling + rising, falling - rising});
        } else {
            for (const int dy : {0, size / 2})
                for (const int dx : {0, size / 2}) add_square(x0 + dx, y0 + dy, size / 2);
        }
    }

    // Change of radius in a direction, from the neighbour in the block that lies on the pixel's surface. 0:
    // neither does.
    float slope(int x, int y, int dx, int dy) const {
        const float own = at(x, y)->coc_px;
        float least = laws::kConnected.step_px;
        for (const int side : {-1, 1}) {
            const int u = x + side * dx, v = y + side * dy;
            if (!block_.contains(u, v)) continue;
            const CocSample* s = at(u, v);
            if (s && std::abs(s->coc_px - own) < std::abs(least)) least = float(side) * (s->coc_px - own);
        }
        return std::abs(least) < laws::kConnected.step_px ? least : 0;
    }

    CocSamplesView samples_;
    Rect block_;
    std::vector<Caster>& out_;
    std::size_t rank_ = 0;
};

// Coarser views leave out what is not nearer than this. No square holds radii from both sides of a power of
// two, so that a view may end at any of them.
constexpr float kFarthestCoarse = -2;

int octave(float coc_px) { return int(std::floor(std::log2(-coc_px))); }

// Squares of less than `size` as squares of that size, each of one surface and as much coverage.
void coarsen(std::span<const Caster> fine, int size, std::vector<Caster>& out) {
    constexpr float kSameShare = 0.02f;  // of the radius: what it shadows moves by less of the pupil
    const auto place = [size](float at) { return int(at + 0.5f) / size; };
    const std::size_t begin = out.size();
    for (const Caster& c : fine) {
        if (c.coc_px > kFarthestCoarse) continue;
        out.push_back(c);
        if (c.size >= float(size)) continue;
        const float middle = 0.5f * float(size - 1);
        out.back().x = float(place(c.x) * size) + middle, out.back().y = float(place(c.y) * size) + middle;
        out.back().coverage *= c.size * c.size / float(size * size);
        out.back().size = float(size);
    }
    const auto own = [&] { return out.begin() + std::ptrdiff_t(begin); };
    std::stable_sort(own(), out.end(), [](const Caster& a, const Caster& b) {
        return std::tie(a.size, a.y, a.x, a.coc_px) < std::tie(b.size, b.y, b.x, b.coc_px);
    });
    std::size_t end = begin;  // of what is merged
    float nearest = 0;        // of the square under way
    for (std::size_t i = begin; i < out.size(); ++i) {
        const Caster c = out[i];
        Caster& last = out[std::max(begin + 1, end) - 1];
        if (end > begin && c.size == float(size) && last.size == c.size && last.x == c.x && last.y == c.y &&
            octave(nearest) == octave(c.coc_px) && c.coc_px - nearest <= -kSameShare * nearest) {
            const float sum = last.coverage + c.coverage;
            const float part = c.coverage / sum;
            last.coc_px += (c.coc_px - last.coc_px) * part;
            last.right_px += (c.right_px - last.right_px) * part;
            last.down_px += (c.down_px - last.down_px) * part;
            last.coverage = std::min(1.0f, sum);
        } else {
            out[end++] = c, nearest = c.coc_px;
        }
    }
    out.resize(end);
    std::stable_sort(own(), out.end(), [](const Caster& a, const Caster& b) { return a.coc_px < b.coc_px; });
}

}  // namespace

ShadowCasters::ShadowCasters(int width, int height)
    : nearest_of_blocks_((width + kBlock - 1) / kBlock, (height + kBlock - 1) / kBlock, 1e30f) {
    for (auto& rows : views_) rows.resize(std::size_t(nearest_of_blocks_.height()));
}

ShadowCasters::ShadowCasters(const CocSamples& samples, Workers& workers)
    : ShadowCasters(samples.width, samples.height()) {
    parallel_for(nearest_of_blocks_.height(), workers, [&](int by) {
        const int y0 = by * kBlock, y1 = std::min(y0 + kBlock, samples.height());
        add(y0, CocSamplesView(samples).rows(y0, y1));
    });
}

void ShadowCasters::add(int y0, const CocSamplesView& rows) {
    float nearest = 1e30f;
    for (int y = 0; y < rows.height(); y += kBlock) {
        const int end = std::min(y + kBlock, rows.height()), by = (y0 + y) / kBlock;
        add_blocks(by, rows.rows(y, end), {0, y0 + y, rows.width(), y0 + end});
        const float* const of_row = nearest_of_blocks_.row(by);
        nearest = std::min(nearest, *std::min_element(of_row, of_row + nearest_of_blocks_.width()));
    }
    for (float known = nearest_; nearest < known && !nearest_.compare_exchange_weak(known, nearest);) {
    }
}

void ShadowCasters::add_blocks(int by, const CocSamplesView& samples, const Rect& rows) {
    RowOfBlocks& fine = views_[0][std::size_t(by)];
    for (auto& view : views_) view[std::size_t(by)].first.push_back(0);
    for (int bx = 0; bx < nearest_of_blocks_.width(); ++bx) {
        const Rect block = Rect{bx * kBlock, rows.y0, (bx + 1) * kBlock, rows.y1}.intersected(rows);
        BlockCasters casters(samples, block, fine.casters);
        for (std::size_t rank = 0, ranks = casters.ranks(); rank < ranks; ++rank) casters.add(rank);
        std::stable_sort(fine.casters.begin() + std::ptrdiff_t(fine.first.back()), fine.casters.end(),
                         [](const Caster& a, const Caster& b) { return a.coc_px < b.coc_px; });
        if (fine.casters.size() > fine.first.back())
            nearest_of_blocks_(bx, by) = fine.casters[fine.first.back()].coc_px;
        fine.first.push_back(fine.casters.size());
        for (int v = 1; v < kViews; ++v) {
            RowOfBlocks& row = views_[std::size_t(v)][std::size_t(by)];
            coarsen(of_block(v - 1, bx, by), 1 << v, row.casters);
            row.first.push_back(row.casters.size());
        }
    }
    for (auto& view : views_) view[std::size_t(by)].casters.shrink_to_fit();  // they last as long as the plan
}

std::span<const Caster> ShadowCasters::of_block(int view, int bx, int by) const {
    const RowOfBlocks& row = views_[std::size_t(view)][std::size_t(by)];
    const std::size_t begin = row.first[std::size_t(bx)], end = row.first[std::size_t(bx) + 1];
    return std::span(row.casters).subspan(begin, end - begin);
}

// A pixel of radius n is coc / (coc - n) taps wide in the disc of a highlight of radius coc.
float ShadowCasters::end_of_view(int view, float highlight_coc_px) {
    constexpr float kWidestTaps = 1;
    if (view == 0) return 1e30f;
    const float size = float(1 << view);
    const float end = highlight_coc_px - size / kWidestTaps * std::max(1.0f, std::abs(highlight_coc_px));
    return end > kFarthestCoarse ? kFarthestCoarse : -std::exp2(std::ceil(std::log2(-end)));
}

}  // namespace petzval::engine
