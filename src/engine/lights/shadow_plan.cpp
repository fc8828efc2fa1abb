#include "engine/lights/shadow_plan.h"

#include "engine/lights/casters_together.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace petzval::engine {
namespace {

constexpr int kLeastCells = 16;  // along a side of a disc's square

class Collector {
public:
    Collector(const LightsPlan& plan, const Viewpoint& view) : plan_(plan), view_(view) {
        for (int v = 0; v < ShadowCasters::kViews; ++v)
            ends_[v] =
                std::min(ShadowCasters::end_of_view(v, view.coc_px), view.coc_px - view.own_surface_px);
    }

    std::vector<CasterRange> collect() {
        constexpr int kBlock = ShadowCasters::kBlock;
        const int farthest = int(reach_of(casters().nearest_coc_px())) + kBlock;
        const Plane& blocks = casters().nearest_of_blocks();
        const int x = int(view_.x), y = int(view_.y);
        const Rect near = Rect{(x - farthest) / kBlock, (y - farthest) / kBlock, (x + farthest) / kBlock + 1,
                               (y + farthest) / kBlock + 1}
                              .intersected(blocks.rect());
        for (int by = near.y0; by < near.y1; ++by)
            for (int bx = near.x0; bx < near.x1; ++bx) {
                const float c = blocks(bx, by);
                if (c >= view_.coc_px - view_.own_surface_px) continue;
                const int dx = std::max({bx * kBlock - x, x - (bx + 1) * kBlock + 1, 0});
                const int dy = std::max({by * kBlock - y, y - (by + 1) * kBlock + 1, 0});
                if (float(dx * dx + dy * dy) > reach_of(c) * reach_of(c)) continue;
                add_block(bx, by, c);
            }
        return std::move(near_);
    }

private:
    const ShadowCasters& casters() const { return *plan_.casters; }
    // Largest distance from the light of a caster of this radius.
    float reach_of(float c) const { return (view_.coc_px - c) * plan_.stretch + 1 + float(view_.size); }

    // Each view of the casters gives those that the coarser views before it do not. No view has a nearer one
    // than `nearest_coc_px`.
    void add_block(int bx, int by, float nearest_coc_px) {
        float done = -1e30f;
        for (int coarse = ShadowCasters::kViews - 1; coarse >= 0; --coarse) {
            const float end = ends_[coarse];
            if (end <= done || end < nearest_coc_px) continue;
            const std::span<const Caster> all = casters().of_block(coarse, bx, by);  // nearest first
            const auto up_to = [&](float coc_px) {
                return std::partition_point(all.begin(), all.end(),
                                            [coc_px](const Caster& c) { return c.coc_px <= coc_px; });
            };
            const auto first = up_to(done), last = up_to(end);
            if (first < last)
                near_.push_back({coarse, by, std::uint32_t(&*first - casters().of_row(coarse, by).data()),
                                 std::uint32_t(last - first)});
            done = end;
        }
    }

    const LightsPlan& plan_;
    const Viewpoint& view_;
    float ends_[ShadowCasters::kViews];  // of what each view of the casters is looked at for
    std::vector<CasterRange> near_;
};

}  // namespace

// Squares of an even number of pixels have their middle, and so the middle of their taps, between two pixels.
ShadowGrid::ShadowGrid(const Viewpoint& view)
    : scale_px(view.coc_px < 0 ? std::min(view.coc_px, -0.5f) : std::max(view.coc_px, 0.5f)),
      taps(2 * int(std::floor(std::abs(view.coc_px) + 0.5f)) + (view.size % 2 == 0 ? 2 : 1)),
      parts(std::max(1, kLeastCells / taps)) {}

OpenSides::OpenSides(const LightsPlan& plan) {
    constexpr float kNever = 1e30f;
    const Rect& r = plan.picture;
    const OpenEdges& open = plan.open_edges;
    left = open.left ? float(r.x0) : -kNever;
    top = open.top ? float(r.y0) : -kNever;
    right = open.right ? float(r.x1) - 1 : kNever;
    bottom = open.bottom ? float(r.y1) - 1 : kNever;
}

// Taps at the rim of the disc reach beyond it by half their width.
float pupil_end(const LightsPlan& plan, const Viewpoint& view) {
    return plan.stretch + (0.5f + 0.5f * float(view.size)) / std::max(0.5f, std::abs(view.coc_px));
}

std::vector<CasterRange> near_casters(const LightsPlan& plan, const Viewpoint& view) {
    if (plan.casters->nearest_coc_px() >= view.coc_px - view.own_surface_px) return {};
    return Collector(plan, view).collect();
}

std::vector<SeenCaster> seen_casters(const LightsPlan& plan, const Viewpoint& view) {
    const std::vector<CasterRange> near = near_casters(plan, view);
    if (near.empty()) return {};
    std::vector<SeenCaster> seen;
    const OpenSides edges(plan);
    const float end = pupil_end(plan, view);
    CastersTogether together;
    std::array<SeenCaster, CastersTogether::kMost> found;
    const auto test = [&] {
        const std::size_t n = together.seen_from(view, edges, end, found.data());
        seen.insert(seen.end(), found.begin(), found.begin() + std::ptrdiff_t(n));
        together.clear();
    };
    for (const CasterRange& range : near) {
        auto left = plan.casters->of_row(range.view, range.row).subspan(range.first, range.count);
        while (!left.empty()) {
            left = left.subspan(together.add(left));
            if (together.size() == CastersTogether::kMost) test();
        }
    }
    test();
    return seen;
}

}  // namespace petzval::engine
