#include "engine/lights/shadow_plan.h"

#include "laws/surfaces.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// A bright light finds every crack that is left between the squares of a surface which bends.
constexpr float kOverlapPx = 0.02f;
constexpr int kLeastCells = 16;  // along a side of a disc's square

class Collector {
public:
    Collector(const LightsPlan& plan, const Viewpoint& view)
        : plan_(plan),
          view_(view),
          // Taps at the rim of the disc reach beyond it by half their width.
          pupil_end_(plan.stretch +
                     (0.5f + 0.5f * float(view.size)) / std::max(0.5f, std::abs(view.coc_px))) {
        for (int v = 0; v < ShadowCasters::kViews; ++v)
            ends_[v] =
                std::min(ShadowCasters::end_of_view(v, view.coc_px), view.coc_px - view.own_surface_px);
    }

    std::vector<SeenCaster> collect() {
        constexpr std::size_t kUsual = 256;
        seen_.reserve(kUsual);
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
                add_block(bx, by);
            }
        return std::move(seen_);
    }

private:
    const ShadowCasters& casters() const { return *plan_.casters; }
    // Largest distance from the light of a caster of this radius.
    float reach_of(float c) const { return (view_.coc_px - c) * plan_.stretch + 1 + float(view_.size); }

    void add_block(int bx, int by) {
        float done = -1e30f;  // all that is nearer has been seen
        for (int coarse = ShadowCasters::kViews - 1; coarse >= 0; --coarse) {
            const float end = ends_[coarse];
            if (end <= done) continue;
            for (const Caster& caster : casters().of_block(coarse, bx, by)) {  // nearest first
                if (caster.coc_px > end) break;
                if (caster.coc_px > done) add(caster);
            }
            done = end;
        }
    }

    void add(const Caster& caster) {
        const float apart = view_.coc_px - caster.coc_px;
        if (view_.is_shown && lies_beside(caster)) return;
        if (caster.size > 1 && apart < ShadowCasters::kSameRadiusPx) return;
        const float per_px = 1 / apart;
        // A tap sees each pixel of the highlight through another place of the caster's plane, wider apart the
        // further that plane is from focus.
        const float blur =
            float(view_.size - 1) * std::abs(caster.coc_px) / std::max(1.0f, std::abs(view_.coc_px));
        const float end = pupil_end_ + 0.5f * blur * per_px;
        const auto misses = [end](const Side& side) { return side.begin >= end || side.end <= -end; };
        const Side across = seen(caster.x, caster.size, view_.x, apart, caster.right_px, plan_.picture.x0,
                                 plan_.picture.x1, plan_.open_edges.left, plan_.open_edges.right);
        if (misses(across)) return;
        const Side down = seen(caster.y, caster.size, view_.y, apart, caster.down_px, plan_.picture.y0,
                               plan_.picture.y1, plan_.open_edges.top, plan_.open_edges.bottom);
        if (misses(down)) return;
        seen_.push_back({across.middle(), down.middle(), across.end - across.begin, down.end - down.begin,
                         blur * per_px, caster.coverage});
    }

    // True if it covers a part of the light's own pixel.
    bool lies_beside(const Caster& caster) const {
        return caster.size == 1 && caster.coverage < laws::kOpaqueCaster && caster.x == view_.x &&
               caster.y == view_.y;
    }
    // A square along one axis of the pupil. Each end has its own radius, so that the squares of a sloping
    // surface meet. One that touches an open edge of the picture continues beyond it.
    struct Side {
        float begin, end;
        float middle() const { return 0.5f * (begin + end); }
    };
    Side seen(float at, float size, float from, float apart, float slope, int first, int last,
              bool opens_before, bool opens_after) const {
        const float half = 0.5f * (size + kOverlapPx), beyond = 2 * pupil_end_;
        const float change = std::clamp(half * slope, -0.5f * apart, 0.5f * apart);
        Side side{(at - half - from) / (apart + change), (at + half - from) / (apart - change)};
        side.end = std::max(side.begin, side.end);  // a surface seen from its back
        if (opens_before && at - 0.5f * size < float(first)) side.begin = std::min(side.begin, -beyond);
        if (opens_after && at + 0.5f * size > float(last) - 1) side.end = std::max(side.end, beyond);
        return side;
    }

    const LightsPlan& plan_;
    const Viewpoint& view_;
    const float pupil_end_;
    float ends_[ShadowCasters::kViews];  // of what each view of the casters is looked at for
    std::vector<SeenCaster> seen_;
};

}  // namespace

// Squares of an even number of pixels have their middle, and so the middle of their taps, between two pixels.
ShadowGrid::ShadowGrid(const Viewpoint& view)
    : scale_px(view.coc_px < 0 ? std::min(view.coc_px, -0.5f) : std::max(view.coc_px, 0.5f)),
      taps(2 * int(std::floor(std::abs(view.coc_px) + 0.5f)) + (view.size % 2 == 0 ? 2 : 1)),
      parts(std::max(1, kLeastCells / taps)) {}

std::vector<SeenCaster> seen_casters(const LightsPlan& plan, const Viewpoint& view) {
    if (plan.casters->nearest_coc_px() >= view.coc_px - view.own_surface_px) return {};
    return Collector(plan, view).collect();
}

}  // namespace petzval::engine
