#include "engine/samples/flat_picture.h"

#include "base/parallel.h"
#include "engine/samples/found_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace petzval::engine {
namespace {

// A sample that takes up `share` of its pixel; what its colour does not cover of that is emptiness.
CocSample sample(Rgba colour, float coc_px, float share) {
    const float empty = share - colour.a;
    return {colour, coc_px, coc_px, empty > 1e-3f ? empty : 0};
}

// The surfaces of a picture, separated and completed.
class FlatPicture final : public CompletedPicture::Parts {
public:
    FlatPicture(const EngineView& input, View<const unsigned char> connected, const Dim& dim)
        : input_(input), found_(surfaces_and_lamps(input, connected, dim)) {
        count();
    }

    void rows(int y0, int y1, CocSamples& all) const override {
        const int width = input_.width();
        const std::size_t before = first_of_row_[std::size_t(y0)];
        restart(all, width, y1 - y0, first_of_row_[std::size_t(y1)] - before);
        parallel_for(y1 - y0, *input_.services.workers, [&](int row) {
            std::size_t at = first_of_row_[std::size_t(y0 + row)] - before;
            const std::size_t pixel = std::size_t(row) * std::size_t(width);
            visit_row(
                y0 + row, [&](int x) { all.first[pixel + std::size_t(x)] = at; },
                [&](const CocSample& s) { all.samples[at++] = s; });
        });
        all.first.back() = all.samples.size();
    }

private:
    // Counts the samples before each row, so that rows can be written in parallel.
    void count() {
        const auto height = std::size_t(input_.height());
        first_of_row_.assign(height + 1, 0);
        std::vector<float> largest(height, 0);
        parallel_for(int(height), *input_.services.workers, [&](int y) {
            std::size_t n = 0;
            float row = 0;
            visit_row(
                y, [](int) {}, [&](const CocSample& s) { ++n, row = std::max(row, std::abs(s.coc_px)); });
            first_of_row_[std::size_t(y) + 1] = n, largest[std::size_t(y)] = row;
        });
        std::partial_sum(first_of_row_.begin(), first_of_row_.end(), first_of_row_.begin());
        sample_count = first_of_row_.back();
        largest_coc_px = *std::max_element(largest.begin(), largest.end());
    }
    // begin(x) for every pixel, then emit(sample) for each of its samples, nearest first.
    template <typename Begin, typename Emit>
    void visit_row(int y, const Begin& begin, const Emit& emit) const {
        const auto lamps = found_->lamps.row(y);
        auto lamp = lamps.begin();
        for (int x = 0; x < input_.width(); ++x) {
            begin(x);
            found_->flat.visit_through_panes(
                input_.samples.colour, input_.samples.coc_px, x, y,
                [&](Rgba c, float coc_px, float share) { emit(sample(c, coc_px, share)); });
            if (lamp != lamps.end() && lamp->x == x) {
                if (found_->flat.is_seen(x, y, lamp->coc_px))
                    emit(CocSample{lamp->light, lamp->coc_px, lamp->coc_px});
                ++lamp;
            }
        }
    }

    const EngineView& input_;
    std::shared_ptr<const FoundSurfaces> found_;
    // Number of the first sample of each row, then the number of all.
    std::vector<std::size_t> first_of_row_;
};

}  // namespace

std::unique_ptr<CompletedPicture::Parts> flat_picture(const EngineView& input,
                                                      View<const unsigned char> connected, const Dim& dim) {
    return std::make_unique<FlatPicture>(input, connected, dim);
}

void restart(CocSamples& samples, int width, int height, std::size_t count) {
    samples.width = width;
    samples.first.clear(), samples.samples.clear();  // the old contents are not copied
    samples.first.resize(std::size_t(width) * std::size_t(height) + 1);
    samples.samples.resize(count);
}

}  // namespace petzval::engine
