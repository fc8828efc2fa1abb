#include "engine/complete.h"

#include "base/parallel.h"
#include "depth/connectivity.h"
#include "depth/hidden.h"

namespace petzval::engine {
namespace {

constexpr float kLeastShare = 1e-3f;

CocSample sample(Rgba colour, float coc_px) { return {colour, coc_px, coc_px}; }

}  // namespace

CocSamples completed(const Input& input) {
    if (!input.deep.empty()) return input.deep;
    const Image<unsigned char> connected = depth::connections(input.coc_px, input.threads);
    const auto mixtures = depth::unmix_silhouettes(input.colour, input.coc_px, connected, input.threads);
    const auto hidden = depth::fill_hidden(input.colour, input.coc_px, connected, mixtures, input.threads);

    // Counted first, then written, so that rows can be done in parallel.
    const int width = input.width(), height = input.height();
    const auto samples_at = [&](int x, int y, const auto& emit) {
        if (const depth::Mixture* m = mixtures.at(x, y)) {
            if (m->near_share > kLeastShare) emit(sample(m->near_colour, m->near_coc_px));
            emit(sample(m->far_colour, m->far_coc_px));
        } else {
            emit(sample(input.colour(x, y), input.coc_px(x, y)));
            for (const depth::Hidden& h : hidden.at(x, y)) emit(sample(h.colour, h.coc_px));
        }
    };
    CocSamples all;
    all.first.assign(std::size_t(width) * std::size_t(height) + 1, 0);
    parallel_for(height, input.threads, [&](int y) {
        for (int x = 0; x < width; ++x) {
            std::size_t n = 0;
            samples_at(x, y, [&](const CocSample&) { ++n; });
            all.first[std::size_t(y) * std::size_t(width) + std::size_t(x) + 1] = n;
        }
    });
    for (std::size_t i = 1; i < all.first.size(); ++i) all.first[i] += all.first[i - 1];
    all.samples.resize(all.first.back());
    parallel_for(height, input.threads, [&](int y) {
        for (int x = 0; x < width; ++x) {
            std::size_t at = all.first[std::size_t(y) * std::size_t(width) + std::size_t(x)];
            samples_at(x, y, [&](const CocSample& s) { all.samples[at++] = s; });
        }
    });
    return all;
}

}  // namespace petzval::engine
