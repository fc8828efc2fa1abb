#include "session/engines.h"

#include "engine/gather/gather.h"
#include "engine/gaussian/gaussian.h"
#include "engine/reference/reference.h"
#include "engine/scatter/scatter.h"
#include "engine/sprites/sprites.h"

#include <string>

namespace petzval::engine {

std::span<const Engine> engines() {
    static constexpr Engine kEngines[] = {
        {"scatter", "final frames: every pixel spreads its own kernel, in depth order", run_scatter, true,
         Layers::ByPlan},
        {"gather", "previews: every pixel collects from a few sizes of the lens's kernel, at half resolution",
         run_gather, false, Layers::OneByOne},
        {"gaussian", "drafts: the sharp picture mixed with two Gaussian blurs; no bokeh, the fastest",
         run_gaussian, false, Layers::OneByOne, true},
        {"sprites", "lights as the lens's own kernels, found or given, over gather or gaussian", run_sprites},
        {"realtime",
         "for games and viewers: near and far at half resolution, on a GPU only; hosts embed this pass",
         run_realtime, false, Layers::OneByOne, true},
        {"reference", "the definition of a correct result, traced through the lens; slow", run_reference,
         true},
    };
    return kEngines;
}

}  // namespace petzval::engine

namespace petzval {
namespace {

Error refuse_engine(const std::string& message, const char* field = "") {
    return {ErrorCode::InvalidArgument, message, field};
}

// Errors: InvalidArgument if the engine takes no layers, or would mix them with surfaces estimated from the
// picture alone.
Status check_layers(const FrameRequest& request, const engine::Engine& e) {
    const Look& look = request.look;
    if (request.rendered.layers.empty() || e.layers == engine::Layers::ByPlan) return Done{};
    if (e.layers == engine::Layers::None)
        return refuse_engine(
            "shot.layers are blurred by job.engine scatter, gather and gaussian, not by " + look.engine,
            "shot.layers");
    if (request.rendered.deep || request.rendered.behind)
        return refuse_engine(
            "shot.layers of pictures with hidden layers are blurred by job.engine scatter alone, not by " +
                look.engine,
            "shot.layers");
    if (look.gather.stage != GatherStage::Final || look.gaussian.view != GaussianView::Result)
        return refuse_engine("shot.layers are blurred in results, not in stages and views", "shot.layers");
    return Done{};
}

}  // namespace

Result<const engine::Engine*> find_engine(const FrameRequest& request) {
    const Look& look = request.look;
    std::string known;
    for (const engine::Engine& e : engine::engines()) {
        if (look.engine != e.name) {
            known += (known.empty() ? "" : ", ") + std::string(e.name);
            continue;
        }
        if (const Status fine = check_layers(request, e); !fine) return fine.error();
        if (request.rendered.holdout && !e.takes_holdout)
            return refuse_engine("job.engine " + look.engine + " takes no holdout; scatter and reference do");
        return &e;
    }
    return refuse_engine("job.engine " + look.engine + " is not known; there are: " + known);
}

}  // namespace petzval
