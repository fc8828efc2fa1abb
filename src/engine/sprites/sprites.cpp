// Lights as the lens's own kernels over a cheap background (docs/explain/published.md): the picture's bright
// points, or points that are given, or both. Gather draws them by itself.
#include "engine/sprites/sprites.h"

#include "engine/gather/gather.h"
#include "engine/gaussian/gaussian.h"
#include "engine/lights/bright_points.h"
#include "engine/lights/sprites.h"
#include "engine/waist/memory.h"
#include "engine/waist/stopwatch.h"

#include <algorithm>

namespace petzval::engine {
namespace {

Result<Output> run_over_gaussian(const EngineView& input) {
    const BrightPoints found(input);
    const BrightPoints::Rest rest = found.rest(0, input.height());
    EngineView below = rest.input();
    GaussianOwn own{input.options.of<SpritesOwn>().gaussian};
    own.gaussian.view = GaussianView::Result;
    below.options.own = own;
    below.services.beside_bytes += found.bytes_beside(input.height());
    if (input.services.max_memory_bytes > 0) {
        const std::size_t least =
            std::max(least_gaussian_bytes(below),
                     whole_picture_bytes(below, sizeof(Rgba)) + sprites_bytes(input, found.count()));
        if (input.services.max_memory_bytes < least) return too_little_memory("sprites", least);
    }
    Result<Output> output = run_gaussian(below);
    if (!output || input.services.progress->cancelled()) return output;
    Stopwatch watch(output->stages);
    const device::Work work = draw_sprites(input, found.sprites(), *output->canvas);
    watch.lap("sprites", work.bytes, work.multiply_adds);
    return output;
}

// Gather draws lights by itself.
Result<Output> run_over_gather(const EngineView& input) {
    const SpritesOwn& own = input.options.of<SpritesOwn>();
    EngineView below = input;
    below.options.own = GatherOwn{own.gather, own.lights};
    return run_gather_for("sprites", below);
}

}  // namespace

Result<Output> run_sprites(const EngineView& input, Spare) {
    const bool over_gather = input.options.lights().background == SpriteBackground::Gather;
    Result<Output> output = over_gather ? run_over_gather(input) : run_over_gaussian(input);
    if (!output) return output.error();
    if (input.services.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    StageTime background{"background"}, sprites{"sprites"};
    for (const StageTime& stage : output->stages) {
        if (stage.stage == sprites.stage)
            sprites = stage;
        else
            background.seconds += stage.seconds;
    }
    output->stages = {background, sprites};
    if (input.options.lights().find && input.samples.deep_dims_itself)
        output->warnings.emplace_back(
            "bright points are not looked for where pixels of a deep picture have several samples");
    return output;
}

}  // namespace petzval::engine
