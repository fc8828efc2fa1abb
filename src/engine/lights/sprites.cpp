#include "engine/lights/sprites.h"

#include "engine/lights/bright_points.h"
#include "engine/lights/sprites_plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace petzval::engine {
namespace {

// A light with a size is an evenly lit disc: points that fill it, closer than the lens resolves.
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

    // Coverage of the cell: 1 inside the disc, falling to 0 over one cell at its rim.
    float covered(int i, int j) const {
        return std::clamp(radius_ / step_ + 0.5f - std::hypot(float(i), float(j)), 0.0f, 1.0f);
    }

    float radius_, step_ = 1;
    int cells_ = 0;
};

// of_frame: lights of the whole frame, if `input` is a part of it. They decide the resolution of the lens
// zones.
device::Work add_sprites(const EngineView& input, std::span<const Sprite> sprites,
                         std::span<const Sprite> of_frame, device::Target out,
                         const std::string& light = {}) {
    if (sprites.empty()) return {};
    SpriteGrid grid(input, sprites);
    if (input.window.whole && input.lens.level(0).varies_over_field()) {
        EngineView frame = *input.window.whole;
        frame.lens.levels = input.lens.levels;
        grid.take_parts_of(SpriteGrid(frame, of_frame));
    }
    const LightsPlan plan = plan_sprites(input, sprites, grid);
    const device::Control control{*input.services.workers, *input.services.progress};
    const auto atlas = input.services.device->atlas(SpriteKernels(input.lens, grid, light), plan.kernels,
                                                    *input.services.memory, control);
    if (input.services.progress->cancelled()) return {};
    return input.services.device->add_lights(plan, *atlas, out, control);
}

// Those of one light, each with its area.
std::vector<Sprite> sprites_of(std::span<const LightPoint> points, LightSpectrum light) {
    std::vector<Sprite> sprites;
    for (const LightPoint& p : points)
        if (p.spectrum == light) AreaOfLight(p).add_to(sprites, p);
    return sprites;
}

// Sprites with the picture's own spectrum, found lights included.
std::vector<Sprite> sprites_of_daylight(const EngineView& input, std::span<const Sprite> found) {
    const auto is_of_lamp = [&](const LightPoint& p) {
        return std::any_of(input.lens.lamps.begin(), input.lens.lamps.end(),
                           [&](const LampLens& lamp) { return p.spectrum == lamp.light; });
    };
    std::vector<Sprite> sprites(found.begin(), found.end());
    for (const LightPoint& p : input.samples.points)
        if (!is_of_lamp(p)) AreaOfLight(p).add_to(sprites, p);
    return sprites;
}

// Lights found in the whole frame, if a part of it must know them.
std::vector<Sprite> sprites_of_frame(const EngineView& input) {
    if (!input.window.whole || !input.lens.level(0).varies_over_field()) return {};
    return sprites_of_daylight(*input.window.whole, BrightPoints(*input.window.whole).sprites());
}

}  // namespace

device::Work draw_sprites(const EngineView& input, std::span<const Sprite> found, device::Target out) {
    const std::vector<Sprite> sprites = sprites_of_daylight(input, found);
    device::Work work;
    if (!sprites.empty()) work = add_sprites(input, sprites, sprites_of_frame(input), out);
    for (const LampLens& lamp : input.lens.lamps) {
        EngineView lit = input;
        lit.lens.levels = lamp.levels;
        work += add_sprites(lit, sprites_of(input.samples.points, lamp.light),
                            sprites_of(input.all().samples.points, lamp.light), out,
                            " of lamp " + std::to_string(int(lamp.light)));
    }
    return work;
}

std::size_t sprites_bytes(const EngineView& input, std::size_t found) {
    // Bytes of the quad-tree of occluders, also of the second ones of given samples; bytes of each light:
    // itself, its copy in a tile, its list entries.
    constexpr std::size_t kBytesPerPixel = 8, kBytesPerPixelOfSecond = 12, kBytesPerPoint = 200;
    std::size_t count = found;
    for (const LightPoint& p : input.samples.points) count += AreaOfLight(p).count();
    if (count == 0) return 0;
    const std::size_t per_pixel = kBytesPerPixel + (input.samples.deep.empty() ? 0 : kBytesPerPixelOfSecond);
    return kBytesPerPoint * count + per_pixel * std::size_t(input.width()) * std::size_t(input.height());
}

}  // namespace petzval::engine
