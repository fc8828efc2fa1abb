// Lights as the lens's own kernels over a cheap background (docs/published.md): the picture's bright
// points, or points that are given, or both.
#include "engine/sprites/sprites.h"

#include "base/parallel.h"
#include "device/device.h"
#include "engine/gather/gather.h"
#include "engine/gaussian/gaussian.h"
#include "engine/lights/highlights.h"
#include "engine/sprites/plan.h"
#include "engine/waist/memory.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <string>

namespace petzval::engine {
namespace {

constexpr float kWithinPixelPx = 0.5f;  // light that is out of focus by less needs no kernel

// The picture without its bright points, and these; its samples, where it has hidden layers.
struct Parted {
    Picture background;
    CocSamples samples;
    std::vector<Sprite> sprites;
};

// Takes what is bright from that sample of a pixel which shows most light: what is hidden keeps its own.
// bright: on return what was taken. Returns where it stands.
float take_bright(std::span<CocSample> samples, Rgba& bright) {
    CocSample* from = nullptr;
    float open = 1, share = 0, most = 0;
    for (CocSample& s : samples) {
        const float seen = std::min(s.colour.a, open), shown = s.colour.a > 0 ? seen / s.colour.a : open;
        if (const float light = shown * luminance(s.colour); light > most)
            from = &s, share = shown, most = light;
        open -= seen;
    }
    if (!from) return bright = {}, 0.0f;
    const auto take = [share](float& light, float& wanted) {
        wanted = std::clamp(share * light, 0.0f, std::max(0.0f, wanted)), light -= wanted;
    };
    take(from->colour.r, bright.r), take(from->colour.g, bright.g), take(from->colour.b, bright.b);
    return from->coc_px;
}

std::span<CocSample> samples_of(CocSamples& all, int x, int y) {
    const std::size_t i = std::size_t(y) * std::size_t(all.width) + std::size_t(x);
    return std::span(all.samples).subspan(all.first[i], all.first[i + 1] - all.first[i]);
}

Parted part(const Input& input) {
    Parted parted{Picture::uninitialised(input.width(), input.height()), {}, {}};
    parted.samples.width = input.deep.width();
    parted.samples.first.assign(input.deep.first().begin(), input.deep.first().end());
    parted.samples.samples.assign(input.deep.samples().begin(), input.deep.samples().end());
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
            const Rgba base = split.base(x, y, coc, light);
            Rgba bright = light - base;
            if (bright.r <= 0 && bright.g <= 0 && bright.b <= 0) continue;
            parted.background(x, y) = base;
            const float radius = input.deep.empty() ? radius_of_brightest(input.colour, input.coc_px, x, y)
                                                    : take_bright(samples_of(parted.samples, x, y), bright);
            rows[std::size_t(y)].push_back(
                {float(x) + 0.5f, float(y) + 0.5f, radius, bright.r, bright.g, bright.b});
        }
    });
    for (const auto& row : rows) parted.sprites.insert(parted.sprites.end(), row.begin(), row.end());
    return parted;
}

// A light with a size is an evenly lit disc: points that fill it, closer than what the lens makes of each
// shows.
class AreaOfLight {
public:
    explicit AreaOfLight(const LightPoint& p) : radius_(p.diameter_px / 2) {
        if (p.diameter_px <= 1) return;
        // In focus and near it every pixel has its point; kernels of far larger lights stand farther apart.
        const float radius_px = std::abs(p.coc_px);
        step_ =
            std::max({1.0f, p.diameter_px / kMostAcross, std::min(radius_px, p.diameter_px) / kKernelSteps});
        cells_ = int(std::ceil(radius_ / step_));
    }
    std::size_t count() const { return std::size_t(2 * cells_ + 1) * std::size_t(2 * cells_ + 1); }
    void add_to(std::vector<Sprite>& sprites, const LightPoint& p) const {
        if (cells_ == 0) {
            sprites.push_back({p.x, p.y, p.coc_px, p.r, p.g, p.b});
            return;
        }
        float sum = 0;
        for (int j = -cells_; j <= cells_; ++j)
            for (int i = -cells_; i <= cells_; ++i) sum += covered(i, j);
        for (int j = -cells_; j <= cells_; ++j)
            for (int i = -cells_; i <= cells_; ++i)
                if (const float share = covered(i, j) / sum; share > 0)
                    sprites.push_back({p.x + step_ * float(i), p.y + step_ * float(j), p.coc_px, share * p.r,
                                       share * p.g, share * p.b});
    }

private:
    static constexpr float kMostAcross = 256, kKernelSteps = 12;

    // Of the cell: 1 inside the disc, falling to 0 over one cell at its rim.
    float covered(int i, int j) const {
        return std::clamp(radius_ / step_ + 0.5f - std::hypot(float(i), float(j)), 0.0f, 1.0f);
    }

    float radius_, step_ = 1;
    int cells_ = 0;
};

std::size_t sprites_of(std::span<const LightPoint> points) {
    std::size_t count = 0;
    for (const LightPoint& p : points) count += AreaOfLight(p).count();
    return count;
}

device::Work add_sprites(const Input& input, std::span<const Sprite> sprites, device::Target out,
                         const std::string& light = {}) {
    if (sprites.empty()) return {};
    const SpriteGrid grid(input, sprites);
    const LightsPlan plan = plan_sprites(input, sprites, grid);
    const device::Control control{*input.workers, *input.progress};
    const auto atlas =
        input.device->atlas(SpriteKernels(input, grid, light), plan.kernels, *input.memory, control);
    if (input.progress->cancelled()) return {};
    return input.device->add_lights(plan, *atlas, out, control);
}

// Those of one light, each with its area.
std::vector<Sprite> sprites_of(std::span<const LightPoint> points, LightSpectrum light) {
    std::vector<Sprite> sprites;
    for (const LightPoint& p : points)
        if (p.spectrum == light) AreaOfLight(p).add_to(sprites, p);
    return sprites;
}

}  // namespace

Result<Output> run_sprites(const Input& input) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const bool finds = input.sprites.find && !input.deep_dims_itself;
    // The picture without its lights, the quad-tree; for every light: itself, its copy in a tile, its place
    // in lists.
    constexpr std::size_t kBytesPerPixel = 2 * sizeof(Rgba) + 8, kBytesPerPoint = 200;
    const std::size_t bytes_of_points = kBytesPerPoint * sprites_of(input.points);
    const bool over_gather = input.sprites.background == SpriteBackground::Gather;
    Input rest = input;
    rest.beside_bytes += bytes_of_points;
    if (finds)
        rest.beside_bytes += sizeof(Rgba) * std::size_t(input.width()) * std::size_t(input.height()) +
                             input.deep.samples().size_bytes() + input.deep.first().size_bytes();
    if (input.max_memory_bytes > 0) {
        const std::size_t least =
            std::max(whole_picture_bytes(input, kBytesPerPixel) + bytes_of_points,
                     over_gather ? least_gather_bytes(rest) : least_gaussian_bytes(rest));
        if (input.max_memory_bytes < least) return too_little_memory("sprites", least);
    }
    Parted parted = finds ? part(input) : Parted{};
    if (finds) rest.colour = parted.background;
    if (finds && !input.deep.empty()) rest.deep = parted.samples;
    rest.gather.stage = GatherStage::Final;
    rest.gaussian.view = GaussianView::Result;
    Result<Output> output = over_gather ? run_gather(rest) : run_gaussian(rest);
    if (!output) return output.error();
    const double drawn_background = seconds();

    const auto is_of_lamp = [&](const LightPoint& p) {
        return std::any_of(input.lamps.begin(), input.lamps.end(),
                           [&](const LampLens& lamp) { return p.spectrum == lamp.light; });
    };
    for (const LightPoint& p : input.points)
        if (!is_of_lamp(p)) AreaOfLight(p).add_to(parted.sprites, p);
    device::Work work = add_sprites(input, parted.sprites, *output->canvas);
    for (const LampLens& lamp : input.lamps) {
        Input lit = input;
        lit.lens_levels = lamp.levels;
        work += add_sprites(lit, sprites_of(input.points, lamp.light), *output->canvas,
                            " of lamp " + std::to_string(int(lamp.light)));
    }
    if (input.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    output->stages = {{"background", drawn_background},
                      {"sprites", seconds() - drawn_background, work.bytes, work.multiply_adds}};
    if (input.sprites.find && !finds)
        output->warnings.emplace_back("bright points are not looked for in pictures with hidden layers");
    return output;
}

}  // namespace petzval::engine
