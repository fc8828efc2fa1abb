#include "session/lamp_layers.h"

#include "petzval/look_check.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace petzval {
namespace {

// Those that the lens is not made for anyhow.
std::set<LightSpectrum> lamps_of(const FrameRequest& request) {
    std::set<LightSpectrum> lamps;
    for (const ColourLayer& layer : request.rendered.layers)
        if (layer.spectrum && *layer.spectrum != request.look.lens.light) lamps.insert(*layer.spectrum);
    return lamps;
}

Error refuse(const std::string& why) {
    return {ErrorCode::InvalidArgument, "shot.layers " + why, "shot.layers"};
}

// The frame as it is with another light, of the layers that are made of it.
Result<FrameRequest> lit_by(const FrameRequest& request, LightSpectrum lamp) {
    FrameRequest lit = request;
    lit.look.lens.light = lamp;
    auto lens = request.lens->with(lit.look.lens);
    if (!lens) return lens.error();
    lit.lens = std::move(*lens);
    std::erase_if(lit.rendered.layers, [&](const ColourLayer& layer) { return layer.spectrum != lamp; });
    return lit;
}

// Replaces a layer by the lit one and adds the lamp's change to the picture.
void exchange(Picture& image, Picture& layer, Picture lit) {
    for (std::size_t i = 0; i < image.size(); ++i) {
        Rgba change = lit.pixels()[i] - layer.pixels()[i];
        change.a = 0;
        image.pixels()[i] += change;
    }
    layer = std::move(lit);
}

}  // namespace

bool has_lamps(const FrameRequest& request) { return !lamps_of(request).empty(); }

Status check_lamps(const FrameRequest& request) {
    for (const LightSpectrum lamp : lamps_of(request)) {
        Look lit = request.look;
        lit.lens.light = lamp;
        for (const Error& idle : check(lit).idle)
            if (idle.field == "lens.light") return refuse("name a lamp, but " + idle.message);
    }
    return Done{};
}

Result<Blurred> with_lamps(const FrameRequest& request, const MakeFrame& make) {
    const std::set<LightSpectrum> lamps = lamps_of(request);
    const std::vector<ColourLayer>& layers = request.rendered.layers;
    for (const ColourLayer& layer : layers)
        if (layer.spectrum && !layer.is_light) return refuse("give a spectrum to a layer that is not light");
    if (!lamps.empty() && request.look.engine == "gaussian")
        return refuse("name a lamp; engine gaussian blurs all wavelengths alike");
    auto made = make(request);
    if (!made || lamps.empty()) return made;
    made->come_home();
    DefocusReport& report = made->report;
    for (const LightSpectrum lamp : lamps) {
        const auto lit = lit_by(request, lamp);
        if (!lit) return lit.error();
        auto of_lamp = make(*lit);
        if (!of_lamp) return of_lamp;
        std::size_t next = 0;
        for (std::size_t i = 0; i < layers.size(); ++i)
            if (layers[i].spectrum == lamp)
                exchange(report.image, report.layers[i], std::move(of_lamp->report.layers[next++]));
        const std::vector<StageTime>& stages = of_lamp->report.stages;
        report.stages.insert(report.stages.end(), stages.begin(), stages.end());
    }
    return made;
}

}  // namespace petzval
