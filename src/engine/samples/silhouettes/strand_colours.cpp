#include "engine/samples/silhouettes/strand_colours.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"

#include <algorithm>

namespace petzval::engine {
namespace {

constexpr int kBlock = SparseRows<Mixture>::kBand;  // side of a block in pixels

float share_at(const Mixture* m) { return m ? m->share_by_shape : 0; }

}  // namespace

StrandColours::StrandColours(const Mixtures& mixtures, const LitPicture& picture, View<const float> coc,
                             Workers& workers)
    : mixtures_(mixtures),
      picture_(picture),
      coc_(coc),
      width_((coc.width() + kBlock - 1) / kBlock),
      height_((coc.height() + kBlock - 1) / kBlock),
      blocks_(std::size_t(width_) * std::size_t(height_)) {
    parallel_for(height_, workers, [&](int by) {
        for (int y = by * kBlock; y < std::min((by + 1) * kBlock, coc.height()); ++y)
            mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
                if (m.thin && coc(x, y) <= strand_threshold_px(m)) state(x, y, m);
            });
    });
}

// Adds what a pixel that shows the strand states of its colour. The background, told by the pixels
// beside it, holds a part of the strand itself.
void StrandColours::state(int x, int y, const Mixture& m) {
    constexpr int kBeside = 2;
    Rgba far;
    float far_holds = 0, total = 0;
    const Rect window =
        Rect{x - kBeside, y - kBeside, x + kBeside + 1, y + kBeside + 1}.intersected(coc_.rect());
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            if (coc_(u, v) <= strand_threshold_px(m)) continue;
            const float d2 = float((u - x) * (u - x) + (v - y) * (v - y)), weight = 1 / (1 + d2 * d2);
            far += weight * comparable(picture_.dim(u, v));
            far_holds += weight * share_at(mixtures_.at(u, v));
            total += weight;
        }
    far_holds /= total;
    const float share = (m.share_by_shape - far_holds) / (1 - far_holds);
    constexpr float kLeast = 0.05f;  // a pixel that holds hardly more than those beside it states nothing
    if (!(share > kLeast)) return;
    const Rgba light = comparable(picture_.dim(x, y)) - ((1 - share) / total) * far;
    const float share2 = share * share;
    Statement& s = statement(x / kBlock, y / kBlock, m.near_coc_px);
    s.share2 += share2;
    s.x += share2 * float(x), s.y += share2 * float(y);
    s.light += share * light;
}

StrandColours::Statement& StrandColours::statement(int bx, int by, float coc_px) {
    auto& block = blocks_[std::size_t(by) * std::size_t(width_) + std::size_t(bx)];
    for (Statement& s : block)
        if (one_surface(s.coc_px, coc_px)) return s;
    block.emplace_back().coc_px = coc_px;
    return block.back();
}

Rgba StrandColours::at(int x, int y, const Mixture& m) const {
    float share2 = 0;
    Rgba light;
    const int bx = x / kBlock, by = y / kBlock;
    for (int v = std::max(0, by - 1); v <= std::min(height_ - 1, by + 1); ++v)
        for (int u = std::max(0, bx - 1); u <= std::min(width_ - 1, bx + 1); ++u)
            for (const Statement& s : blocks_[std::size_t(v) * std::size_t(width_) + std::size_t(u)]) {
                if (!one_surface(s.coc_px, m.near_coc_px)) continue;
                const float dx = s.x / s.share2 - float(x), dy = s.y / s.share2 - float(y);
                const float weight = 1 / (1 + (dx * dx + dy * dy) / float(kBlock * kBlock));
                share2 += weight * s.share2;
                light += weight * s.light;
            }
    return share2 > 0 ? light_only((1 / share2) * light) : m.near_clean;
}

}  // namespace petzval::engine
