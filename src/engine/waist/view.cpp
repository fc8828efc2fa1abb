#include "engine/waist/view.h"

namespace petzval::engine {

Samples Samples::rows(int y0, int y1) const {
    Samples part = *this;
    const Rect r{0, y0, colour.width(), y1};
    part.colour = colour.part(r), part.coc_px = coc_px.part(r);
    if (!picture.empty()) part.picture = picture.part(r);
    if (!depth_m.empty()) part.depth_m = depth_m.part(r);
    if (!plate.empty()) part.plate = plate.part(r);
    for (SampleLayer& layer : part.layers) layer.colour = layer.colour.part(r);
    part.deep = deep.rows(y0, y1), part.holdout = holdout.rows(y0, y1);
    return part;
}

EngineView EngineView::rows(int y0, int y1) const {
    EngineView part = *this;
    part.samples = samples.rows(y0, y1);
    part.window.whole = &all();
    part.lens = lens.from(0, y0);
    if (y0 > 0) part.window.open_edges.top = true;
    if (y1 < height()) part.window.open_edges.bottom = true;
    return part;
}

CocSamples stated_samples(const Samples& samples) {
    const View<const Rgba>& colour = samples.colour;
    CocSamples all;
    all.width = colour.width();
    if (!samples.deep.empty()) {
        const std::size_t start = samples.deep.first().front();
        for (const std::size_t first : samples.deep.first()) all.first.push_back(first - start);
        const auto of_rows = samples.deep.samples().subspan(start, all.first.back());
        all.samples.assign(of_rows.begin(), of_rows.end());
        return all;
    }
    const std::size_t pixels = std::size_t(colour.width()) * std::size_t(colour.height());
    all.first.resize(pixels + 1);
    all.samples.resize(pixels);
    for (int y = 0; y < colour.height(); ++y)
        for (int x = 0; x < colour.width(); ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(colour.width()) + std::size_t(x);
            all.first[i] = i;
            all.samples[i] = {colour(x, y), samples.coc_px(x, y), samples.coc_px(x, y)};
        }
    all.first[pixels] = pixels;
    return all;
}

}  // namespace petzval::engine
