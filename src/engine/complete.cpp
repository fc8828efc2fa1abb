#include "engine/complete.h"

#include "base/parallel.h"
#include "depth/connectivity.h"
#include "depth/hidden.h"

namespace petzval::engine {
namespace {

constexpr float kLeastShare = 1e-3f;

// A sample that takes up `share` of its pixel; what its colour does not cover of that is emptiness.
CocSample sample(Rgba colour, float coc_px, float share) {
    const float empty = share - colour.a;
    return {colour, coc_px, coc_px, empty > kLeastShare ? empty : 0};
}

// Ends every pixel that the picture shows to be transparent in emptiness. (Coverages of a pixel's samples
// need not sum to 1 where it is opaque: surfaces that meet in it share it.)
CocSamples with_emptiness(const CocSamples& stated, View<const Rgba> picture) {
    CocSamples all;
    all.width = stated.width;
    all.first.reserve(stated.first.size());
    all.samples.reserve(stated.samples.size());
    for (std::size_t i = 0; i + 1 < stated.first.size(); ++i) {
        all.first.push_back(all.samples.size());
        const auto begin = stated.samples.begin() + std::ptrdiff_t(stated.first[i]);
        const auto end = stated.samples.begin() + std::ptrdiff_t(stated.first[i + 1]);
        all.samples.insert(all.samples.end(), begin, end);
        const float alpha = picture(int(i % std::size_t(stated.width)), int(i / std::size_t(stated.width))).a;
        if (alpha > 1 - kLeastShare) continue;
        if (begin == end) all.samples.push_back({});
        all.samples.back().empty = 1;
    }
    all.first.push_back(all.samples.size());
    return all;
}

}  // namespace

CocSamples completed(const Input& input) {
    if (!input.deep.empty()) return with_emptiness(stated_samples(input), input.colour);
    const Image<unsigned char> connected = depth::connections(input.coc_px, input.threads);
    const auto mixtures = depth::unmix_silhouettes(input.colour, input.coc_px, connected, input.threads);
    const auto hidden = depth::fill_hidden(input.colour, input.coc_px, connected, mixtures,
                                           input.nearest_coc_px, input.farthest_coc_px, input.threads);

    // Counted first, then written, so that rows can be done in parallel.
    const int width = input.width(), height = input.height();
    const auto samples_at = [&](int x, int y, const auto& emit) {
        if (const depth::Mixture* m = mixtures.at(x, y)) {
            if (m->near_share > kLeastShare) emit(sample(m->near_colour, m->near_coc_px, m->near_share));
            emit(sample(m->far_colour, m->far_coc_px, 1));
        } else {
            emit(sample(input.colour(x, y), input.coc_px(x, y), 1));
            for (const depth::Hidden& h : hidden.at(x, y)) emit(sample(h.colour, h.coc_px, h.share));
        }
    };
    CocSamples all;
    all.width = width;
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
