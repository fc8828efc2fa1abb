#include "engine/samples/complete.h"

#include "engine/samples/deep/deep_completed.h"
#include "engine/samples/flat_picture.h"
#include "engine/samples/sample_source.h"

#include <algorithm>
#include <utility>

namespace petzval::engine {
namespace {

// Samples that are all made beforehand.
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

}  // namespace

CompletedPicture::CompletedPicture(const EngineView& input, View<const unsigned char> connected,
                                   const Dim& dim)
    : height_(input.height()) {
    if (input.samples.are_stated())
        parts_ = std::make_unique<GivenSamples>(deep_completed(input, connected, dim));
    else
        parts_ = flat_picture(input, connected, dim);
}

}  // namespace petzval::engine
