#include "session/engines.h"

#include "engine/gather/gather.h"
#include "engine/gaussian/gaussian.h"
#include "engine/reference/reference.h"
#include "engine/scatter/scatter.h"
#include "engine/sprites/sprites.h"

namespace petzval::engine {

std::span<const Engine> engines() {
    static constexpr Engine kEngines[] = {
        {"scatter", "final frames: every pixel spreads its own kernel, in depth order", run_scatter, true,
         Layers::ByPlan},
        {"gather", "previews: every pixel collects from a few sizes of the lens's kernel, at half resolution",
         run_gather, false, Layers::OneByOne},
        {"gaussian", "drafts: the sharp picture mixed with two Gaussian blurs; no bokeh, the fastest",
         run_gaussian, false, Layers::OneByOne},
        {"sprites", "lights as the lens's own kernels, found or given, over gather or gaussian", run_sprites},
        {"realtime", "as games draw it, on a GPU alone: what hosts embed, near and far at half resolution",
         run_realtime, false, Layers::OneByOne},
        {"reference", "the definition of a correct result, traced through the lens; slow", run_reference,
         true},
    };
    return kEngines;
}

}  // namespace petzval::engine
