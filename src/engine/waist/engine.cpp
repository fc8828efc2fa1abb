#include "engine/waist/engine.h"

namespace petzval::engine {

CocSamples stated_samples(const Input& input) {
    CocSamples all;
    all.width = input.width();
    if (!input.deep.empty()) {
        const std::size_t start = input.deep.first().front();
        for (const std::size_t first : input.deep.first()) all.first.push_back(first - start);
        const auto samples = input.deep.samples().subspan(start, all.first.back());
        all.samples.assign(samples.begin(), samples.end());
        return all;
    }
    const std::size_t pixels = std::size_t(input.width()) * std::size_t(input.height());
    all.first.resize(pixels + 1);
    all.samples.resize(pixels);
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(input.width()) + std::size_t(x);
            all.first[i] = i;
            all.samples[i] = {input.colour(x, y), input.coc_px(x, y), input.coc_px(x, y)};
        }
    all.first[pixels] = pixels;
    return all;
}

}  // namespace petzval::engine
