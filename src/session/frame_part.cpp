#include "session/frame_part.h"

#include "engine/samples/behind/smooth.h"
#include "engine/samples/lamps/lamps.h"
#include "engine/samples/outlines/hidden_outlines.h"

#include <algorithm>
#include <cmath>

namespace petzval {
namespace {

engine::CocSamples part_of(const engine::CocSamplesView& whole, const Rect& pixels) {
    engine::CocSamples part;
    if (whole.empty()) return part;
    part.width = pixels.width();
    part.first.push_back(0);
    for (int y = pixels.y0; y < pixels.y1; ++y)
        for (int x = pixels.x0; x < pixels.x1; ++x) {
            const auto samples = whole.at(x, y);
            part.samples.insert(part.samples.end(), samples.begin(), samples.end());
            part.first.push_back(part.samples.size());
        }
    return part;
}

}  // namespace

int region_margin_px(double largest_radius_px, double reach_px) {
    constexpr double kMost = 1 << 20;  // of any picture
    // The other end of a lamp comes from as far as it is wide, and so far one has to look to know how wide.
    constexpr int kAround =
        std::max(2 * engine::kWidestLampPx + 40, engine::kOutlineReachPx + engine::kSmoothReachPx);
    return int(std::ceil(std::min(kMost, 4 * std::max(largest_radius_px, reach_px)))) + kAround;
}

Rect pixels_for(const Rect& region, int margin_px, int grid, const Rect& frame) {
    const Rect seen = region.grown(margin_px).intersected(frame);
    const auto up = [grid](int at) { return (at + grid - 1) / grid * grid; };
    return Rect{seen.x0 / grid * grid, seen.y0 / grid * grid, up(seen.x1), up(seen.y1)}.intersected(frame);
}

Status check_region(const Rect& region, const FrameRequest& request) {
    const auto refuse = [](const char* why) { return Error{ErrorCode::InvalidArgument, why}; };
    if (request.view != ScatterView::Result)
        return refuse("control.region is for results, not for layers, levels and highlights");
    if (region.intersected(request.rendered.place.data_window).empty())
        return refuse("control.region lies outside of the data window");
    return Done{};
}

Picture part_of(const Picture& image, const Rect& pixels) {
    Picture part = Picture::uninitialised(pixels.width(), pixels.height());
    for (int y = 0; y < part.height(); ++y)
        std::copy_n(image.row(y + pixels.y0) + pixels.x0, part.width(), part.row(y));
    return part;
}

engine::EngineView part_of(const engine::EngineView& whole, const Rect& pixels, PartMemory& memory) {
    engine::EngineView view = whole;
    const engine::Samples& all = whole.samples;
    engine::Samples& part = view.samples;
    memory.deep = part_of(all.deep, pixels), memory.holdout = part_of(all.holdout, pixels);
    part.colour = all.colour.part(pixels);
    part.coc_px = all.coc_px.part(pixels);
    if (!all.depth_m.empty()) part.depth_m = all.depth_m.part(pixels);
    for (engine::SampleLayer& layer : part.layers) layer.colour = layer.colour.part(pixels);
    if (!all.deep.empty()) part.deep = memory.deep;
    if (!all.plate.empty()) part.plate = all.plate.part(pixels);
    if (!all.holdout.empty()) part.holdout = memory.holdout;
    memory.points.assign(all.points.begin(), all.points.end());
    for (LightPoint& p : memory.points) p.x -= float(pixels.x0), p.y -= float(pixels.y0);
    part.points = memory.points;
    // The scene continues beyond edges of the part inside the frame.
    const Rect frame = all.colour.rect();
    engine::OpenEdges& open = view.window.open_edges;
    open.left = open.left || pixels.x0 > frame.x0, open.top = open.top || pixels.y0 > frame.y0;
    open.right = open.right || pixels.x1 < frame.x1, open.bottom = open.bottom || pixels.y1 < frame.y1;
    view.window.whole = &whole;
    view.lens = whole.lens.from(pixels.x0, pixels.y0);
    return view;
}

}  // namespace petzval
