// Lights as the lens's own kernels over a cheap background (docs/published.md): the picture's bright
// points, or points that are given, or both.
#include "engine/sprites/sprites.h"

#include "base/parallel.h"
#include "engine/gather/gather.h"
#include "engine/gaussian/gaussian.h"
#include "engine/lights/highlights.h"
#include "engine/sprites/sprites_draw.h"
#include "engine/waist/memory.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kWithinPixelPx = 0.5f;  // light that is out of focus by less needs no kernel

// The picture without its bright points, and these.
struct Parted {
    Picture background;
    std::vector<Sprite> sprites;
};

// A pixel on the rim of a lamp shows lamp and surroundings, and its depth may be that of the surroundings:
// the bright part of its light stands where the brightest pixel around it does.
float radius_of_light(const Input& input, int x, int y) {
    float brightest = luminance(input.colour(x, y)), coc = input.coc_px(x, y);
    for (int v = std::max(0, y - 1); v <= std::min(input.height() - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(input.width() - 1, x + 1); ++u)
            if (const float there = luminance(input.colour(u, v)); there > brightest)
                brightest = there, coc = input.coc_px(u, v);
    return coc;
}

Parted part(const Input& input) {
    Parted parted{Picture::uninitialised(input.width(), input.height()), {}};
    const HighlightRule rule{.factor = float(input.sprites.bright_factor),
                             .least_floor = 1,
                             .floor_at_1px = 0,
                             .contested_floor = 1};
    const HighlightSplit split(input, rule);
    std::vector<std::vector<Sprite>> rows{std::size_t(input.height())};
    parallel_for(input.height(), *input.workers, [&](int y) {
        for (int x = 0; x < input.width(); ++x) {
            const Rgba light = input.colour(x, y);
            const float coc = input.coc_px(x, y);
            parted.background(x, y) = light;
            if (std::abs(coc) <= kWithinPixelPx) continue;
            const Rgba base = split.base(x, y, coc, light), bright = light - base;
            if (bright.r <= 0 && bright.g <= 0 && bright.b <= 0) continue;
            parted.background(x, y) = base;
            rows[std::size_t(y)].push_back({float(x) + 0.5f, float(y) + 0.5f, radius_of_light(input, x, y),
                                            bright.r, bright.g, bright.b});
        }
    });
    for (const auto& row : rows) parted.sprites.insert(parted.sprites.end(), row.begin(), row.end());
    return parted;
}

// A disc of diameter d blurred by one of radius r has the second moment of one of radius sqrt(r^2 + d^2/4).
Sprite sprite_of(const LightPoint& p) {
    const float radius = std::hypot(p.coc_px, p.diameter_px / 2);
    return {p.x, p.y, p.coc_px < 0 ? -radius : radius, p.r, p.g, p.b};
}

}  // namespace

Result<Output> run_sprites(const Input& input) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const bool finds = input.sprites.find && input.deep.empty();
    // The picture without its lights, the quad-tree; for every light: itself, its copy in a tile, its place
    // in lists.
    constexpr std::size_t kBytesPerPixel = 2 * sizeof(Rgba) + 8, kBytesPerPoint = 200;
    if (const Status fits =
            fits_memory(input, kBytesPerPixel, "sprites", kBytesPerPoint * input.points.size());
        !fits)
        return fits.error();
    Parted parted = finds ? part(input) : Parted{};
    Input rest = input;
    if (finds) rest.colour = parted.background;
    if (input.max_memory_bytes > 0)  // what the background leaves to the points
        rest.max_memory_bytes -= kBytesPerPoint * input.points.size() + parted.background.bytes();
    rest.gather.stage = GatherStage::Final;
    rest.gaussian.view = GaussianView::Result;
    Result<Output> output =
        input.sprites.background == SpriteBackground::Gather ? run_gather(rest) : run_gaussian(rest);
    if (!output) return output.error();
    const double drawn_background = seconds();

    for (const LightPoint& p : input.points) parted.sprites.push_back(sprite_of(p));
    draw_sprites(input, parted.sprites, output->image);
    if (input.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    output->stages = {{"background", drawn_background}, {"sprites", seconds() - drawn_background}};
    if (input.sprites.find && !finds)
        output->warnings.emplace_back("bright points are not looked for in pictures with hidden layers");
    return output;
}

}  // namespace petzval::engine
