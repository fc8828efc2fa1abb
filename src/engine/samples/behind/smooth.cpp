#include "engine/samples/behind/smooth.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::engine {
namespace {

using Ranges = SparseRows<HiddenLayers::Range>;
constexpr int kBand = HiddenLayers::kBand;

class Pass {
public:
    Pass(const Ranges& ranges, const HiddenGuesses& guesses, const KnownSurfaces& known, int spacing)
        : ranges_(ranges), guesses_(guesses), known_(known), spacing_(spacing) {}

    // Colours of a band after the pass.
    std::vector<Rgba> band(int band, int height) const {
        const auto& own = guesses_[std::size_t(band)];
        std::vector<Rgba> colours(own.size());
        for (std::size_t i = 0; i < own.size(); ++i) colours[i] = own[i].seen.colour;
        std::vector<bool> met(own.size());  // pixels share guesses: the first one is where it was made
        for (int y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y)
            ranges_.for_each_in_row(y, [&](int x, const HiddenLayers::Range& range) {
                for (std::size_t i = range.begin; i < std::size_t(range.begin) + range.count; ++i)
                    if (!met[i] && 2 * own[i].smooth_px > float(spacing_)) {
                        met[i] = true;
                        colours[i] = mean(x, y, height, own[i]);
                    }
            });
        return colours;
    }

private:
    Rgba mean(int x, int y, int height, const HiddenGuess& own) const {
        constexpr std::array<float, 2> kWeights{2, 1};  // of a 3 x 3 binomial filter
        Rgba sum = 4 * own.plain * own.seen.colour;
        const CutEdges::Around edges = known_.edges_around(x, y, 1.5f * float(spacing_), own.seen.coc_px);
        float total = 4 * own.plain;
        for (int dy = -1; dy <= 1; ++dy) {
            const int v = y + dy * spacing_;
            if (v < 0 || v >= height) continue;
            for (int dx = -1; dx <= 1; ++dx) {
                const int u = x + dx * spacing_;
                if ((dx == 0 && dy == 0) || u < 0 || u >= ranges_.width()) continue;
                const HiddenGuess* other = same_surface(u, v, own.seen.coc_px);
                if (!other) continue;
                const float weight = kWeights[std::size_t(std::abs(dx))] *
                                     kWeights[std::size_t(std::abs(dy))] * other->plain *
                                     edges.passes({u, v}, own.seen.coc_px);
                sum += weight * other->seen.colour;
                total += weight;
            }
        }
        if (total <= 0) return own.seen.colour;
        const float part = std::min(1.0f, 2 * own.smooth_px / float(spacing_) - 1);
        return (1 - part) * own.seen.colour + (part / total) * sum;
    }
    const HiddenGuess* same_surface(int x, int y, float coc_px) const {
        const HiddenLayers::Range* range = ranges_.at(x, y);
        if (!range) return nullptr;
        const HiddenGuess *first = guesses_[std::size_t(y / kBand)].data() + range->begin, *best = nullptr;
        for (const HiddenGuess* g = first; g != first + range->count; ++g)
            if (one_surface(g->seen.coc_px, coc_px) &&
                (!best || std::abs(g->seen.coc_px - coc_px) < std::abs(best->seen.coc_px - coc_px)))
                best = g;
        return best;
    }

    const Ranges& ranges_;
    const HiddenGuesses& guesses_;
    const KnownSurfaces& known_;
    int spacing_;
};

}  // namespace

void smooth(const Ranges& ranges, HiddenGuesses& guesses, const KnownSurfaces& known, Workers& workers) {
    const int bands = int(guesses.size());
    std::vector<std::vector<Rgba>> smoothed(guesses.size());
    for (int spacing = 1; spacing <= kSmoothWidestPx; spacing *= 2) {
        const Pass pass(ranges, guesses, known, spacing);
        parallel_for(bands, workers,
                     [&](int b) { smoothed[std::size_t(b)] = pass.band(b, ranges.height()); });
        parallel_for(bands, workers, [&](int b) {
            for (std::size_t i = 0; i < smoothed[std::size_t(b)].size(); ++i)
                guesses[std::size_t(b)][i].seen.colour = smoothed[std::size_t(b)][i];
        });
    }
}

}  // namespace petzval::engine
