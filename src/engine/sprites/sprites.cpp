// Lights as the lens's own kernels over a cheap background (docs/published.md): the picture's bright
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

Result<Output> run_over_gaussian(const Input& input) {
    const BrightPoints found(input);
    const BrightPoints::Rest rest = found.rest(0, input.height());
    Input below = rest.input();
    below.beside_bytes += found.bytes_beside(input.height());
    if (input.max_memory_bytes > 0) {
        const std::size_t least =
            std::max(least_gaussian_bytes(below),
                     whole_picture_bytes(below, sizeof(Rgba)) + sprites_bytes(input, found.count()));
        if (input.max_memory_bytes < least) return too_little_memory("sprites", least);
    }
    Result<Output> output = run_gaussian(below);
    if (!output || input.progress->cancelled()) return output;
    Stopwatch watch(output->stages);
    const device::Work work = draw_sprites(input, found.sprites(), *output->canvas);
    watch.lap("sprites", work.bytes, work.multiply_adds);
    return output;
}

}  // namespace

Result<Output> run_sprites(const Input& input) {
    Input results = input;
    results.gaussian.view = GaussianView::Result;
    const bool over_gather = input.sprites.background == SpriteBackground::Gather;
    Result<Output> output = over_gather ? run_gather_for("sprites", results) : run_over_gaussian(results);
    if (!output) return output.error();
    if (input.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    StageTime background{"background"}, sprites{"sprites"};
    for (const StageTime& stage : output->stages) {
        if (stage.stage == sprites.stage)
            sprites = stage;
        else
            background.seconds += stage.seconds;
    }
    output->stages = {background, sprites};
    if (input.sprites.find && !BrightPoints::are_looked_for(input))
        output->warnings.emplace_back("bright points are not looked for in deep pictures");
    return output;
}

}  // namespace petzval::engine
