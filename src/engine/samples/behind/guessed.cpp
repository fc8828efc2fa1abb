#include "engine/samples/behind/guessed.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace petzval::engine {
namespace {

constexpr int kLeastBlock = 4, kLongestSearch = 20;  // in pixels; in blocks
constexpr int kDirections = 16;
constexpr float kSteepest = 0.3f;  // largest change of the radius per pixel within one surface
constexpr float kBlurredPx = 1;    // a sharper occluder hides nothing that a lens would see past it

bool one_surface(float coc_a, float coc_b) {
    return std::abs(coc_a - coc_b) < 1.5f + 0.1f * std::max(std::abs(coc_a), std::abs(coc_b));
}

// Weight of lamps in a mean of dim light: small if they are brighter than kLampContrast times the usual light
// (the square of the mean root), nearly 0 where bright light must not be invented.
class WithoutLamps {
public:
    explicit WithoutLamps(Fill fill) : dim_(fill == Fill::Dim) {}
    void see(Rgba colour, float weight) {
        roots_ += weight * std::sqrt(std::max(0.0f, luminance(colour))), weight_ += weight;
    }
    // Weight of a visible colour.
    float share(Rgba colour) const {
        constexpr float kLampContrast = 4;
        const float usual = kLampContrast * (roots_ / weight_) * (roots_ / weight_) + 1e-6f;
        const float excess = std::max(0.0f, luminance(colour)) / usual, squared = excess * excess;
        return 1 / (1 + (dim_ ? squared * squared : squared));
    }

private:
    bool dim_;
    float roots_ = 0, weight_ = 0;
};

// The nearest radius in a block, and the mean of its farthest surface.
struct Block {
    float nearest_px = 1e30f, farthest_px = -1e30f;
    Rgba colour, judged;
};

Block block_of(const EngineView& input, const Rect& area) {
    Block block;
    WithoutLamps lamps(input.options.fill);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            block.nearest_px = std::min(block.nearest_px, input.samples.coc_px(x, y));
            block.farthest_px = std::max(block.farthest_px, input.samples.coc_px(x, y));
        }
    const auto visit_surface = [&](const auto& visit) {
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x)
                if (one_surface(input.samples.coc_px(x, y), block.farthest_px)) visit(x, y);
    };
    const bool dim = input.options.fill == Fill::Dim;
    const View<const Rgba> judged = input.samples.judged();
    if (dim) visit_surface([&](int x, int y) { lamps.see(judged(x, y), 1); });
    float count = 0, coc = 0, shares = 0;
    visit_surface([&](int x, int y) {
        const float share = dim ? lamps.share(judged(x, y)) : 1;
        block.colour += share * input.samples.colour(x, y), block.judged += share * judged(x, y);
        shares += share, coc += input.samples.coc_px(x, y), count += 1;
    });
    block.colour *= 1 / shares, block.judged *= 1 / shares;
    block.farthest_px = coc / count;
    return block;
}

// A piece of a surface: its colour, and the colour by which it is judged.
struct Seen {
    Rgba colour, judged;
    float coc_px = 0;
};

// Surfaces met: the one with the largest weight wins, and its pieces are averaged.
class Votes {
public:
    explicit Votes(Fill fill) : fill_(fill) {}
    void clear() { count_ = 0, all_ = 0; }
    void add(const Seen& seen, float weight) {
        votes_[std::size_t(count_++)] = {seen, weight};
        all_ += weight;
    }
    bool empty() const { return count_ == 0; }
    // Mean of the winning pieces; requires at least one.
    Seen result() const {
        float best = 0;
        Seen out;
        for (int i = 0; i < count_ && best < 0.5f * all_; ++i) {
            float sum = 0;
            const Seen mean = mean_like(votes_[std::size_t(i)].seen.coc_px, sum);
            if (sum > best) best = sum, out = mean;
        }
        return out;
    }

private:
    Seen mean_like(float coc_px, float& sum) const {
        Seen mean;
        WithoutLamps lamps(fill_);
        visit_like(coc_px, [&](const Vote& vote) { lamps.see(vote.seen.judged, vote.weight); });
        float shares = 0;
        visit_like(coc_px, [&](const Vote& vote) {
            const float share = vote.weight * lamps.share(vote.seen.judged);
            mean.colour += share * vote.seen.colour, mean.judged += share * vote.seen.judged;
            mean.coc_px += vote.weight * vote.seen.coc_px, shares += share, sum += vote.weight;
        });
        mean.colour *= 1 / shares, mean.judged *= 1 / shares, mean.coc_px /= sum;
        return mean;
    }
    template <typename Visit>
    void visit_like(float coc_px, const Visit& visit) const {
        for (int i = 0; i < count_; ++i)
            if (one_surface(votes_[std::size_t(i)].seen.coc_px, coc_px)) visit(votes_[std::size_t(i)]);
    }

    struct Vote {
        Seen seen;
        float weight;
    };
    Fill fill_;
    std::array<Vote, kDirections + 1> votes_;
    int count_ = 0;
    float all_ = 0;
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

class BlockFill {
public:
    explicit BlockFill(const EngineView& input)
        : fill_(input.options.fill),
          block_(fill_block_px(input.samples.nearest_coc_px)),
          blocks_((input.width() + block_ - 1) / block_, (input.height() + block_ - 1) / block_),
          fills_(blocks_.width(), blocks_.height()) {
        parallel_for(blocks_.height(), *input.services.workers, [&](int y) {
            for (int x = 0; x < blocks_.width(); ++x)
                blocks_(x, y) = block_of(
                    input, Rect{x * block_, y * block_, (x + 1) * block_, (y + 1) * block_}.intersected(
                               input.samples.colour.rect()));
        });
        const auto paths = search_paths();
        parallel_for(blocks_.height(), *input.services.workers, [&](int y) {
            for (int x = 0; x < blocks_.width(); ++x)
                if (blocks_(x, y).nearest_px <= -kBlurredPx) fills_(x, y) = fill(x, y, paths);
        });
    }

    // The blocks around a pixel vote, if what they found is farther than it by a pixel of radius.
    void vote(int x, int y, float coc_px, Votes& votes) const {
        constexpr float kCountsPx = 2.8f;  // a block's vote weighs like a hit at this distance
        const float u = (float(x) + 0.5f) / float(block_) - 0.5f,
                    v = (float(y) + 0.5f) / float(block_) - 0.5f;
        const int left = int(std::floor(u)), top = int(std::floor(v));
        const View<const Fill> fills = fills_;
        for (int j = top; j <= top + 1; ++j)
            for (int i = left; i <= left + 1; ++i) {
                const Fill& fill = fills.clamped(i, j);
                if (!fill.found || fill.seen.coc_px <= coc_px + 1) continue;
                const float weight = (1 - std::abs(u - float(i))) * (1 - std::abs(v - float(j)));
                votes.add(fill.seen, weight / (kCountsPx * kCountsPx));
            }
    }
    // True if a farther surface lies within two blocks of a pixel that has a fill.
    bool is_by_edge(int x, int y) const { return fills_(x / block_, y / block_).by_edge; }

private:
    struct Fill {
        Seen seen;
        bool found = false, by_edge = false;
    };

    Fill fill(int x, int y, const std::array<std::vector<Offset>, kDirections>& paths) const {
        const float own = blocks_(x, y).nearest_px, step_up = 1 + kSteepest * float(block_);
        Fill filled;
        Votes votes(fill_);
        const auto add = [&](const Block& met, float distance) {
            votes.add({met.colour, met.judged, met.farthest_px}, 1 / (distance * distance));
            filled.by_edge = filled.by_edge || distance <= 2;
        };
        if (blocks_(x, y).farthest_px > own + step_up) add(blocks_(x, y), 0.5f);
        const int steps = std::min(kLongestSearch, 2 + int(std::ceil(-own / float(block_))));
        for (const auto& path : paths) {
            float surface = own;
            for (int t = 0; t < steps; ++t) {
                const Offset& o = path[std::size_t(t)];
                if (!blocks_.rect().contains(x + o.x, y + o.y)) break;
                const Block& met = blocks_(x + o.x, y + o.y);
                if (met.farthest_px > surface + step_up) {
                    add(met, o.distance);
                    break;
                }
                surface = std::max(surface, met.farthest_px);
            }
        }
        filled.found = !votes.empty();
        if (filled.found) filled.seen = votes.result();
        return filled;
    }

    petzval::Fill fill_;
    int block_;
    Image<Block> blocks_;
    Image<Fill> fills_;
};

class PixelFill {
public:
    PixelFill(const EngineView& input, View<const Touched> touched)
        : input_(input), judged_(input.samples.judged()), touched_(touched), blocks_(input) {}

    // `votes`: scratch memory.
    std::optional<FilledIn> at(int x, int y, Votes& votes) const {
        const float own = input_.samples.coc_px(x, y);
        if (own > -kBlurredPx) return std::nullopt;
        votes.clear();
        blocks_.vote(x, y, own, votes);
        if (votes.empty()) return std::nullopt;
        if (blocks_.is_by_edge(x, y))
            for (int k = 0; k < 8; ++k) look(x, y, k, votes);
        const Seen hidden = votes.result();
        return FilledIn{hidden.colour, hidden.coc_px};
    }

private:
    // Adds the first farther surface met in this direction, past its rim. A surface so little farther that
    // blur hardly separates the two counts as the occluder's continuation.
    void look(int x, int y, int direction, Votes& votes) const {
        constexpr int kReach = 8;
        constexpr float kFarther = 0.5f;  // fraction of the pixel's own radius
        // Steps in x; the step in y is the entry two later.
        constexpr std::array<int, 10> kSteps{1, 1, 0, -1, -1, -1, 0, 1, 1, 1};
        const int dx = kSteps[std::size_t(direction)], dy = kSteps[std::size_t(direction) + 2];
        const float step = dx != 0 && dy != 0 ? float(M_SQRT2) : 1.0f;
        float surface = input_.samples.coc_px(x, y);
        const float step_up = std::max(kUnlikePx, kFarther * std::abs(surface));
        for (int t = 1; float(t) * step <= kReach; ++t) {
            int u = x + t * dx, v = y + t * dy;
            if (!touched_.rect().contains(u, v)) return;
            const float met = input_.samples.coc_px(u, v);
            if (met - surface <= step_up) {
                surface = std::max(surface, met);
                continue;
            }
            if (touched_(u, v) == Touched::ByNearer && touched_.rect().contains(u + dx, v + dy) &&
                std::abs(input_.samples.coc_px(u + dx, v + dy) - met) <= kUnlikePx)
                u += dx, v += dy;
            votes.add({input_.samples.colour(u, v), judged_(u, v), input_.samples.coc_px(u, v)},
                      1 / (float(t * t) * step * step));
            return;
        }
    }

    const EngineView& input_;
    View<const Rgba> judged_;
    View<const Touched> touched_;
    BlockFill blocks_;
};

}  // namespace

int fill_block_px(float nearest_coc_px) {
    int size = kLeastBlock;
    while (-nearest_coc_px + 2 > float(size * (kLongestSearch - 2))) size *= 2;
    return size;
}

int fill_reach_px(float nearest_coc_px) {
    if (nearest_coc_px > -kBlurredPx) return 0;
    return int(std::ceil(-nearest_coc_px)) + 5 * fill_block_px(nearest_coc_px);
}

HiddenFill fill_hidden(const EngineView& input, View<const Touched> touched) {
    const float nearest = input.samples.nearest_coc_px, farthest = input.samples.farthest_coc_px;
    if (nearest > -kBlurredPx || farthest < nearest + 1) return {};
    const PixelFill pixels(input, touched);
    return HiddenFill(input.width(), input.height(), *input.services.workers, [&](int y, const auto& emit) {
        Votes votes(input.options.fill);
        for (int x = 0; x < input.width(); ++x)
            if (const auto hidden = pixels.at(x, y, votes)) emit(x, *hidden);
    });
}

Guessed guess(const EngineView& input, bool fills) {
    const Image<Touched> touched = find_touched(input.samples.coc_px, *input.services.workers);
    Guessed guessed;
    if (fills) guessed.fill = fill_hidden(input.with_all_light(), touched);
    guessed.rims = find_rims(input.samples.colour, input.samples.judged(), input.samples.coc_px, touched,
                             *input.services.workers);
    return guessed;
}

}  // namespace petzval::engine
