#include "session/lamp_layers.h"

#include "petzval/look_check.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace petzval {
namespace {

LensChoice choice_of(const DefocusJob& job) { return job.opened_lens ? job.opened_lens->choice() : job.lens; }

// Those that the lens is not made for anyhow.
std::set<LightSpectrum> lamps_of(const DefocusJob& job) {
    std::set<LightSpectrum> lamps;
    for (const ColourLayer& layer : job.layers)
        if (layer.spectrum && *layer.spectrum != choice_of(job).light) lamps.insert(*layer.spectrum);
    return lamps;
}

Error refuse(const std::string& why) {
    return {ErrorCode::InvalidArgument, "shot.layers " + why, "shot.layers"};
}

// The frame as it is with another light, of the layers that are made of it.
Result<DefocusJob> lit_by(const DefocusJob& job, LightSpectrum lamp) {
    DefocusJob lit = job;
    lit.lens = choice_of(job);
    lit.lens.light = lamp;
    lit.opened_lens.reset();
    if (job.opened_lens) {
        auto lens = job.opened_lens->with(lit.lens);
        if (!lens) return lens.error();
        lit.opened_lens = std::move(*lens);
    }
    std::erase_if(lit.layers, [&](const ColourLayer& layer) { return layer.spectrum != lamp; });
    return lit;
}

// What the lamp changes of a layer, in the picture as well.
void exchange(Picture& image, Picture& layer, Picture lit) {
    for (std::size_t i = 0; i < image.size(); ++i) {
        Rgba change = lit.pixels()[i] - layer.pixels()[i];
        change.a = 0;
        image.pixels()[i] += change;
    }
    layer = std::move(lit);
}

}  // namespace

Status check_lamps(const DefocusJob& job, const Look& look) {
    for (const LightSpectrum lamp : lamps_of(job)) {
        Look lit = look;
        lit.lens.light = lamp;
        for (const Error& idle : check(lit).idle)
            if (idle.field == "lens.light") return refuse("name a lamp, but " + idle.message);
    }
    return Done{};
}

Result<DefocusReport> with_lamps(const DefocusJob& job, const MakeFrame& make) {
    const std::set<LightSpectrum> lamps = lamps_of(job);
    for (const ColourLayer& layer : job.layers)
        if (layer.spectrum && !layer.is_light) return refuse("name a lamp for what is no light");
    if (!lamps.empty() && job.engine == "gaussian")
        return refuse("name a lamp; engine gaussian blurs all wavelengths alike");
    auto report = make(job);
    for (const LightSpectrum lamp : lamps) {
        if (!report) break;
        const auto lit = lit_by(job, lamp);
        if (!lit) return lit.error();
        auto of_lamp = make(*lit);
        if (!of_lamp) return of_lamp;
        std::size_t next = 0;
        for (std::size_t i = 0; i < job.layers.size(); ++i)
            if (job.layers[i].spectrum == lamp)
                exchange(report->image, report->layers[i], std::move(of_lamp->layers[next++]));
        report->stages.insert(report->stages.end(), of_lamp->stages.begin(), of_lamp->stages.end());
    }
    return report;
}

}  // namespace petzval
