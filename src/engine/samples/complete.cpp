#include "engine/samples/complete.h"

#include "engine/samples/behind/out_of_sight.h"
#include "engine/samples/behind/plate.h"
#include "engine/samples/connectivity.h"
#include "engine/samples/deep/deep_completed.h"
#include "engine/samples/flat_picture.h"
#include "engine/samples/found_surfaces.h"
#include "engine/samples/sample_source.h"

#include <algorithm>
#include <utility>

namespace petzval::engine {
namespace {

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
    const CleanPlate& plate = input.samples.plate;
    const LitPicture picture{input.samples.colour, dim};
    Workers& workers = *input.services.workers;
    const int height = input.height();
    FoundSurfaces front{found_surfaces(input, connected, dim), {}};
    unmix_before_plate(front.flat.mixtures, picture, input.samples.coc_px, plate, workers);
    CocSamples back, all;
    EngineView behind = input;
    behind.samples.colour = plate.colour, behind.samples.coc_px = plate.coc_px;
    flat_picture(behind, connections(plate.coc_px, workers), dim)->rows(0, height, back);
    picture_before_plate(input, std::move(front), back, plate.coc_px)->rows(0, height, all);
    if (!plate.all) drop_out_of_sight(all, input.lens.level(0).reach_px(1), input.window.open_edges, workers);
    return all;
}

}  // namespace

CompletedPicture::CompletedPicture(const EngineView& input, View<const unsigned char> connected,
                                   const Dim& dim)
    : height_(input.height()) {
    if (!input.samples.plate.empty() && input.samples.plate.covers)
        parts_ = std::make_unique<GivenSamples>(completed_before_plate(input, connected, dim));
    else if (input.samples.are_all_stated())
        parts_ = std::make_unique<GivenSamples>(deep_completed(input));
    else
        parts_ = flat_picture(input, connected, dim);
}

}  // namespace petzval::engine
