#include "engine/scatter/guessed_shares.h"

#include "base/parallel.h"
#include "engine/samples/deep/end_of_pixel.h"
#include "engine/samples/seen_share.h"

namespace petzval::engine {

std::vector<Rgba> guessed_shares(const EngineView& view, const CocSamples& complete) {
    std::vector<Rgba> shares(complete.samples.size());
    if (view.options.fill == Fill::Off) return shares;
    const CocSamplesView& deep = view.samples.deep;
    constexpr float kSameRadiusPx = 0.25f;
    const auto is_given = [&](int x, int y, const CocSample& s) {
        return !view.samples.plate.empty() && view.samples.plate.is_stated(x, y) &&
               s.coc_px > view.samples.plate.coc_px(x, y) - kSameRadiusPx;
    };
    parallel_for(view.height(), *view.services.workers, [&](int y) {
        for (int x = 0; x < view.width(); ++x) {
            float open = 1;
            const bool is_stated = view.samples.are_stated() && !is_flat_pixel(deep, x, y);
            std::size_t stated = is_stated ? deep.at(x, y).size() : 0;
            std::size_t i = complete.first[std::size_t(y) * std::size_t(view.width()) + std::size_t(x)];
            for (const CocSample& s : CocSamplesView(complete).at(x, y)) {
                const float guessed =
                    is_stated ? float(stated == 0 && !is_behind_everything(s)) : 1 - seen(s, open);
                if (stated > 0) --stated;
                if (!is_given(x, y, s)) shares[i] = {guessed, guessed, guessed, 0};
                ++i;
            }
        }
    });
    return shares;
}

}  // namespace petzval::engine
