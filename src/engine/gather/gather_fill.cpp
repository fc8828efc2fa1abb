#include "engine/gather/gather_fill.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kLeastBlock = 4, kLongestSearch = 20;  // pixels; blocks
constexpr int kDirections = 16;
constexpr float kSteepest = 0.3f;  // change of radius per pixel that still is one surface
constexpr float kBlurredPx = 1;    // what is sharper hides nothing that a lens looks past

bool one_surface(float coc_a, float coc_b) {
    return std::abs(coc_a - coc_b) < 1.5f + 0.1f * std::max(std::abs(coc_a), std::abs(coc_b));
}

// What lamps count in a mean of what is dim: next to nothing where they are brighter than kLampContrast times
// the usual light, the square of the mean root.
class WithoutLamps {
public:
    explicit WithoutLamps(Fill fill) : dim_(fill == Fill::Dim) {}
    void see(Rgba colour, float weight) {
        if (dim_) roots_ += weight * std::sqrt(std::max(0.0f, luminance(colour))), weight_ += weight;
    }
    // Of one that was seen.
    float share(Rgba colour) const {
        if (!dim_) return 1;
        constexpr float kLampContrast = 4;
        const float usual = kLampContrast * (roots_ / weight_) * (roots_ / weight_) + 1e-6f;
        const float excess = std::max(0.0f, luminance(colour)) / usual;
        return 1 / (1 + excess * excess * excess * excess);
    }

private:
    bool dim_;
    float roots_ = 0, weight_ = 0;
};

// The nearest radius in a block, and the mean of its farthest surface.
struct Block {
    float nearest_px = 1e30f, farthest_px = -1e30f;
    Rgba colour;
};

Block block_of(const Input& input, const Rect& area) {
    Block block;
    WithoutLamps lamps(input.fill);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            block.nearest_px = std::min(block.nearest_px, input.coc_px(x, y));
            block.farthest_px = std::max(block.farthest_px, input.coc_px(x, y));
        }
    const auto visit_surface = [&](const auto& visit) {
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x)
                if (one_surface(input.coc_px(x, y), block.farthest_px))
                    visit(input.colour(x, y), input.coc_px(x, y));
    };
    visit_surface([&](Rgba colour, float) { lamps.see(colour, 1); });
    float count = 0, coc = 0, shares = 0;
    visit_surface([&](Rgba colour, float coc_px) {
        const float share = lamps.share(colour);
        block.colour += share * colour, shares += share, coc += coc_px, count += 1;
    });
    block.colour *= 1 / shares;
    block.farthest_px = coc / count;
    return block;
}

// What was met: the surface that most of it belongs to wins, its pieces are averaged.
class Votes {
public:
    explicit Votes(Fill fill) : fill_(fill) {}
    void add(const Block& block, float distance) {
        votes_[std::size_t(count_++)] = {&block, 1 / (distance * distance)};
    }
    bool result(CocSample& out) const {
        float best = 0;
        for (int i = 0; i < count_; ++i) {
            float sum = 0;
            const CocSample mean = mean_like(votes_[std::size_t(i)].block->farthest_px, sum);
            if (sum > best) best = sum, out = mean;
        }
        return best > 0;
    }

private:
    CocSample mean_like(float coc_px, float& sum) const {
        CocSample mean;
        WithoutLamps lamps(fill_);
        visit_like(coc_px, [&](const Block& block, float weight) { lamps.see(block.colour, weight); });
        float shares = 0;
        visit_like(coc_px, [&](const Block& block, float weight) {
            const float share = weight * lamps.share(block.colour);
            mean.colour += share * block.colour, shares += share;
            mean.coc_px += weight * block.farthest_px, sum += weight;
        });
        mean.colour *= 1 / shares;
        mean.coc_px /= sum, mean.coc_back_px = mean.coc_px;
        return mean;
    }
    template <typename Visit>
    void visit_like(float coc_px, const Visit& visit) const {
        for (int i = 0; i < count_; ++i) {
            const auto& [block, weight] = votes_[std::size_t(i)];
            if (one_surface(block->farthest_px, coc_px)) visit(*block, weight);
        }
    }

    struct Vote {
        const Block* block;
        float weight;
    };
    Fill fill_;
    std::array<Vote, kDirections + 1> votes_;
    int count_ = 0;
};

struct Offset {
    int x, y;
    float distance;
};

std::array<std::vector<Offset>, kDirections> search_paths() {
    std::array<std::vector<Offset>, kDirections> paths;
    for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * M_PI * (k + 0.5) / kDirections;
        for (int t = 1; t <= kLongestSearch; ++t)
            paths[std::size_t(k)].push_back(
                {int(std::lround(t * std::cos(angle))), int(std::lround(t * std::sin(angle))), float(t)});
    }
    return paths;
}

}  // namespace

int BlockFill::block_px(float nearest_coc_px) {
    int size = kLeastBlock;
    while (-nearest_coc_px + 2 > float(size * (kLongestSearch - 2))) size *= 2;
    return size;
}

int BlockFill::reach_px(float nearest_coc_px) {
    if (nearest_coc_px > -kBlurredPx) return 0;
    return int(std::ceil(-nearest_coc_px)) + 5 * block_px(nearest_coc_px);
}

BlockFill BlockFill::make(const Input& input) {
    const float nearest = input.nearest_coc_px, farthest = input.farthest_coc_px;
    BlockFill fill;
    if (nearest > -kBlurredPx || farthest < nearest + 1) return fill;
    fill.block_ = block_px(nearest);
    const int b = fill.block_;
    Image<Block> blocks((input.width() + b - 1) / b, (input.height() + b - 1) / b);
    parallel_for(blocks.height(), *input.workers, [&](int y) {
        for (int x = 0; x < blocks.width(); ++x)
            blocks(x, y) =
                block_of(input, Rect{x * b, y * b, x * b + b, y * b + b}.intersected(input.colour.rect()));
    });
    const auto paths = search_paths();
    fill.fills_ = Image<Fill>(blocks.width(), blocks.height());
    parallel_for(blocks.height(), *input.workers, [&](int y) {
        for (int x = 0; x < blocks.width(); ++x) {
            const float own = blocks(x, y).nearest_px;
            if (own > -kBlurredPx) continue;
            Votes votes(input.fill);
            const float step_up = 1 + kSteepest * float(b);
            if (blocks(x, y).farthest_px > own + step_up) votes.add(blocks(x, y), 0.5f);
            const int steps = std::min(kLongestSearch, 2 + int(std::ceil(-own / float(b))));
            for (const auto& path : paths) {
                float surface = own;
                for (int t = 0; t < steps; ++t) {
                    const Offset& o = path[std::size_t(t)];
                    if (!blocks.rect().contains(x + o.x, y + o.y)) break;
                    const Block& met = blocks(x + o.x, y + o.y);
                    if (met.farthest_px > surface + step_up) {
                        votes.add(met, o.distance);
                        break;
                    }
                    surface = std::max(surface, met.farthest_px);
                }
            }
            fill.fills_(x, y).found = votes.result(fill.fills_(x, y).sample);
        }
    });
    return fill;
}

std::optional<CocSample> BlockFill::blended(int x, int y, float coc_px) const {
    const float u = (float(x) + 0.5f) / float(block_) - 0.5f, v = (float(y) + 0.5f) / float(block_) - 0.5f;
    const int left = int(std::floor(u)), top = int(std::floor(v));
    const View<const Fill> fills = fills_;
    const Fill& own = fills(x / block_, y / block_);
    if (!own.found || own.sample.coc_px <= coc_px + 1) return std::nullopt;
    CocSample sum;
    float total = 0;
    for (int j = top; j <= top + 1; ++j)
        for (int i = left; i <= left + 1; ++i) {
            const Fill& fill = fills.clamped(i, j);
            if (!fill.found || !one_surface(fill.sample.coc_px, own.sample.coc_px)) continue;
            const float weight = (1 - std::abs(u - float(i))) * (1 - std::abs(v - float(j)));
            sum.colour += weight * fill.sample.colour, sum.coc_px += weight * fill.sample.coc_px;
            total += weight;
        }
    if (total <= 0) return own.sample;
    sum.colour *= 1 / total;
    sum.coc_px /= total, sum.coc_back_px = sum.coc_px;
    return sum;
}

}  // namespace petzval::engine
