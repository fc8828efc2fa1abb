#include "base/parallel.h"
#include "engine/samples/behind/shared_answers.h"
#include "engine/samples/behind/surfaces_behind.h"
#include "engine/samples/hidden.h"

#include <algorithm>
#include <optional>

namespace petzval::engine {
namespace {

using Range = HiddenLayers::Range;

Range range(std::size_t begin, std::size_t end) {
    Range r{};
    r.begin = begin & ((1U << 30) - 1), r.count = (end - begin) & HiddenLayers::kMost;
    return r;
}

// Rows of the picture that are filled one square after the other.
struct Band {
    const SurfacesBehind& surfaces;
    const Mixtures& mixtures;
    View<const float> coc;
    Rect rows;
    const FillRule& rule;
    Image<Range> ranges;  // of its pixels in `hidden`
    std::vector<HiddenGuess> hidden;
    SharedAnswers answers;

    void fill_square(const Rect& square) {
        answers.clear();
        for (int y = square.y0; y < square.y1; ++y)
            for (int x = square.x0; x < square.x1; ++x) {
                const Mixture* m = mixtures.at(x, y);
                // (A silhouette's farther surface hides another one if it lies in front of focus itself.)
                if (m && m->shows_far && m->far_coc_px > -completion_model.apart_px()) continue;
                if ((m && !m->shows_far ? m->near_coc_px : coc(x, y)) > rule.hides_before_px) continue;
                if ((!m || m->shows_far) && !surfaces.may_hide(x, y)) continue;
                Range& own = ranges(x, y - rows.y0);
                if (const Range* const known = answers.find(x, y, coc(x, y))) {
                    own = *known;
                    continue;
                }
                const std::size_t begin = hidden.size();
                const float outline_px = surfaces.fill(x, y, hidden);
                hidden.resize(std::min(hidden.size(), begin + HiddenLayers::kMost));
                own = range(begin, hidden.size());
                // Nothing found here; neighbours closer to the silhouette may still find
                // something.
                if (own.count == 0) continue;
                answers.add(x, y, coc(x, y),
                            shared_square(std::span(hidden).subspan(begin), rule, outline_px), own);
            }
    }
};

}  // namespace

HiddenLayers fill_hidden(const LitPicture& picture, View<const float> coc,
                         View<const unsigned char> connected, const Mixtures& mixtures, float nearest_coc_px,
                         float farthest_coc_px, const FillRule& rule, Workers& workers) {
    return fill_hidden(picture, coc, connected, mixtures, nearest_coc_px, farthest_coc_px, rule, 0, workers);
}

HiddenLayers fill_hidden(const LitPicture& picture, View<const float> coc,
                         View<const unsigned char> connected, const Mixtures& mixtures, float nearest_coc_px,
                         float farthest_coc_px, const FillRule& rule, float white, Workers& workers) {
    const int width = coc.width(), height = coc.height();
    HiddenLayers layers;
    const SurfacesBehind surfaces(picture, coc, connected, mixtures, nearest_coc_px, farthest_coc_px, rule,
                                  white, workers);
    const int bands = (height + kLargestSquare - 1) / kLargestSquare;
    layers.bands.resize(std::size_t(bands));
    layers.ranges = {width, height};
    HiddenGuesses guesses(static_cast<std::size_t>(bands));
    parallel_for(bands, workers, [&](int i) {
        const Rect rows =
            Rect{0, i * kLargestSquare, width, (i + 1) * kLargestSquare}.intersected(coc.rect());
        Band band{surfaces, mixtures, coc, rows, rule, Image<Range>(width, rows.height()), {}, {}};
        for (int x = 0; x < width; x += kLargestSquare)
            band.fill_square(Rect{x, rows.y0, x + kLargestSquare, rows.y1}.intersected(rows));
        for (int y = rows.y0; y < rows.y1; ++y)
            layers.ranges.find_row(y, [&](const auto& emit) {
                for (int x = 0; x < width; ++x)
                    if (const Range r = band.ranges(x, y - rows.y0); r.count > 0) emit(x, r);
            });
        guesses[std::size_t(i)].assign(band.hidden.begin(), band.hidden.end());  // without spare capacity
    });
    if (std::all_of(guesses.begin(), guesses.end(), [](const auto& band) { return band.empty(); })) return {};
    if (rule.smooths) smooth(layers.ranges, guesses, surfaces.known(), workers);
    parallel_for(bands, workers, [&](int i) {
        std::vector<Hidden>& seen = layers.bands[std::size_t(i)];
        seen.reserve(guesses[std::size_t(i)].size());
        for (const HiddenGuess& g : guesses[std::size_t(i)])
            seen.push_back(
                {g.seen.share * (g.plain * g.seen.colour + g.texture), g.seen.coc_px, g.seen.share});
        guesses[std::size_t(i)] = {};
    });
    return layers;
}

}  // namespace petzval::engine
