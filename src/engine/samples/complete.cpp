#include "engine/samples/complete.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/behind/out_of_sight.h"
#include "engine/samples/behind/plate.h"
#include "engine/samples/connectivity.h"
#include "engine/samples/flat_surfaces.h"
#include "engine/samples/hidden.h"
#include "engine/samples/kept_surfaces.h"
#include "engine/samples/lamps.h"
#include "engine/samples/lens_left.h"
#include "engine/samples/sample_source.h"
#include "image/two_sweeps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace petzval::engine {
namespace {

constexpr float kLeastShare = 1e-3f;

// A sample that takes up `share` of its pixel; what its colour does not cover of that is emptiness.
CocSample sample(Rgba colour, float coc_px, float share) {
    const float empty = share - colour.a;
    return {colour, coc_px, coc_px, empty > kLeastShare ? empty : 0};
}

// Resizes samples that will be overwritten; keeps their memory.
void restart(CocSamples& samples, int width, int height, std::size_t count) {
    samples.width = width;
    samples.first.clear(), samples.samples.clear();  // the old contents are not copied
    samples.first.resize(std::size_t(width) * std::size_t(height) + 1);
    samples.samples.resize(count);
}

// Distance to the nearest transparent pixel (the larger of columns and rows); large if there is none.
Image<int> distance_to_emptiness(View<const Rgba> picture) {
    constexpr int kFar = 1 << 20;
    Image<int> distance(picture.width(), picture.height(), kFar);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (picture(x, y).a <= 1 - kLeastShare) distance(x, y) = 0;
    two_sweeps(picture.width(), picture.height(), [&](int x, int y, int dx, int dy) {
        distance(x, y) = std::min(distance(x, y), distance(x + dx, y + dy) + 1);
    });
    return distance;
}

// The stated samples, with emptiness behind transparent pixels and behind pixels so near to one that a lens
// looks past their edges: emptiness continues behind an occluder as surfaces do. It takes the rest of a
// pixel's lens and is no wider than the pixel. (Coverages of an opaque pixel's samples need not sum to 1:
// surfaces that meet in it share it.)
CocSamples deep_completed(const EngineView& input) {
    const CocSamples stated = stated_samples(input.samples);
    const Image<int> distance = distance_to_emptiness(input.samples.colour);
    const double stretch = input.lens.level(0).reach_px(1);
    CocSamples all;
    all.width = stated.width;
    all.first.reserve(stated.first.size());
    all.samples.reserve(stated.samples.size());
    for (std::size_t i = 0; i + 1 < stated.first.size(); ++i) {
        all.first.push_back(all.samples.size());
        float largest = 0;
        for (std::size_t k = stated.first[i]; k < stated.first[i + 1]; ++k) {
            all.samples.push_back(stated.samples[k]);
            largest = std::max(largest, std::abs(stated.samples[k].coc_px));
        }
        const bool looks_past = double(distance.pixels()[i]) <= stretch * double(largest) + 1;
        const float open = 1 - input.samples.colour.row(int(i) / stated.width)[int(i) % stated.width].a;
        if (distance.pixels()[i] == 0 || looks_past) {
            all.samples.push_back(emptiness_behind_everything());
        } else if (open > 1e-6f) {  // a smaller rest gives no reliable colour
            all.samples.push_back(emptiness_behind_everything());
            all.samples.back().empty = open;
        }
    }
    all.first.push_back(all.samples.size());
    return all;
}

// The surfaces of a picture, separated and completed. In front of a plate, only the surfaces before it:
// `back` is the completed plate.
class FlatPicture final : public CompletedPicture::Parts {
public:
    FlatPicture(const EngineView& input, View<const unsigned char> connected, const Dim& dim,
                const CocSamples* back = nullptr)
        : input_(input), back_(back) {
        const auto find = [&] { return found(input, connected, dim, back); };
        const std::uint64_t rules =
            1 + 16 * std::uint64_t(input.options.quality) + 256 * std::uint64_t(input.options.fill);
        found_ = back ? std::make_shared<const FoundSurfaces>(find())
                      : kept_or_found(input, input.samples.colour, dim, rules, find);
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
    static FoundSurfaces found(const EngineView& input, View<const unsigned char> connected, const Dim& dim,
                               const CocSamples* back) {
        const LitPicture picture{input.samples.colour, dim};
        const View<const float> coc_px = input.samples.coc_px;
        Workers& workers = *input.services.workers;
        // A draft searches half as much.
        const bool draft = input.options.quality == Quality::Draft;
        const UnmixRule unmix = draft ? UnmixRule::draft() : UnmixRule{};
        FillRule fill = draft ? FillRule::draft() : FillRule{};
        if (input.options.quality == Quality::Final) fill.first_directions = fill.directions;
        FoundSurfaces s;
        s.flat.mixtures = unmix_silhouettes(picture, coc_px, connected, workers, unmix);
        if (input.options.fill != Fill::Off)
            s.flat.hidden =
                fill_hidden(picture, coc_px, connected, s.flat.mixtures, input.samples.nearest_coc_px,
                            input.samples.farthest_coc_px, fill, dim.white, workers);
        unmix_nearer(s.flat.mixtures, picture, s.flat.hidden, workers);
        if (back) unmix_before_plate(s.flat.mixtures, picture, coc_px, input.samples.plate, workers);
        if (dim && !back && input.options.fill == Fill::Full)
            s.lamps = lamps_behind(picture, coc_px, s.flat.mixtures, workers);
        return s;
    }
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
            const auto emit_before_plate = [&](const CocSample& s) {
                if (!back_ || is_before_plate(s.coc_px, input_.samples.plate.coc_px(x, y))) emit(s);
            };
            visit_surfaces(x, y, emit_before_plate);
            if (lamp != lamps.end() && lamp->x == x)
                emit_before_plate({lamp->light, lamp->coc_px, lamp->coc_px}), ++lamp;
            if (back_)
                for (const CocSample& s : CocSamplesView(*back_).at(x, y)) emit(s);
        }
    }
    template <typename Emit>
    void visit_surfaces(int x, int y, const Emit& emit) const {
        const View<const Rgba> colour = input_.samples.colour;
        // The plate shows through the uncovered part of the picture.
        found_->flat.visit(colour, input_.samples.coc_px, x, y, back_ ? colour(x, y).a : 1,
                           [&](Rgba c, float coc_px, float share) { emit(sample(c, coc_px, share)); });
    }

    const EngineView& input_;
    const CocSamples* back_;
    std::shared_ptr<const FoundSurfaces> found_;
    // Number of the first sample of each row, then the number of all.
    std::vector<std::size_t> first_of_row_;
};

// Samples that the input states completely; nothing is estimated.
class GivenSamples final : public CompletedPicture::Parts {
public:
    explicit GivenSamples(CocSamples all) : all_(std::move(all)) {
        sample_count = all_.samples.size();
        largest_coc_px = SampleSource(all_).largest_coc_px();
    }
    void rows(int y0, int y1, CocSamples& part) const override {
        const auto pixels = CocSamplesView(all_).rows(y0, y1).first();
        const std::size_t begin = pixels.front(), end = pixels.back();
        restart(part, all_.width, y1 - y0, end - begin);
        std::transform(pixels.begin(), pixels.end(), part.first.begin(),
                       [begin](std::size_t first) { return first - begin; });
        std::copy(all_.samples.begin() + std::ptrdiff_t(begin), all_.samples.begin() + std::ptrdiff_t(end),
                  part.samples.begin());
    }

private:
    CocSamples all_;
};

CocSamples completed_before_plate(const EngineView& input, View<const unsigned char> connected,
                                  const Dim& dim) {
    EngineView plate = input;
    plate.samples.colour = input.samples.plate.colour, plate.samples.coc_px = input.samples.plate.coc_px;
    const int height = input.height();
    CocSamples back, all;
    FlatPicture(plate, connections(plate.samples.coc_px, *input.services.workers), dim).rows(0, height, back);
    FlatPicture(input, connected, dim, &back).rows(0, height, all);
    if (!input.samples.plate.all)
        drop_out_of_sight(all, input.lens.level(0).reach_px(1), *input.services.workers);
    return all;
}

}  // namespace

CompletedPicture::CompletedPicture(const EngineView& input, View<const unsigned char> connected,
                                   const Dim& dim)
    : height_(input.height()) {
    if (!input.samples.plate.empty())
        parts_ = std::make_unique<GivenSamples>(completed_before_plate(input, connected, dim));
    else if (!input.samples.deep.empty())
        parts_ = std::make_unique<GivenSamples>(deep_completed(input));
    else
        parts_ = std::make_unique<FlatPicture>(input, connected, dim);
}

void share_lens_area(CocSamples& samples, Workers& workers) {
    parallel_for(samples.height(), workers, [&](int y) {
        const std::size_t row = std::size_t(y) * std::size_t(samples.width);
        for (std::size_t i = row; i < row + std::size_t(samples.width); ++i) {
            float open = 1;
            LensLeft left;
            LayersOfPixel layers(true);
            bool dimmed_in_layer = false, full_in_layer = false;
            int layer = std::numeric_limits<int>::min();
            for (std::size_t k = samples.first[i]; k < samples.first[i + 1]; ++k) {
                CocSample& s = samples.samples[k];
                if (const int own = layers.at(s.coc_px); own != layer) {
                    layer = own;
                    dimmed_in_layer = full_in_layer = false;
                }
                const float alpha = s.colour.a;
                const bool opaque = alpha > 1 - kLeastShare;
                // The room that other surfaces leave is found where they are composited.
                left.meet(layer);
                if (!opaque || dimmed_in_layer)
                    s.colour *= full_in_layer || open <= 0 ? 0 : std::min(1.0f, open / left.before);
                // The coverage of a dimmed sample no longer shows that it hides the samples behind it.
                if (opaque && dimmed_in_layer) full_in_layer = true;
                if (!opaque) left.take(s.colour.a, layer), open *= 1 - alpha, dimmed_in_layer = true;
                layers.next(s);
            }
        }
    });
}

}  // namespace petzval::engine
