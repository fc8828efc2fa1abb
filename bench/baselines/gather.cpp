// Plain gather: every pixel averages the pixels around it whose discs reach it, by the rule that compositors
// and games share (e.g. Riguer, Tatarchuk, Isidoro, "Real-Time Depth of Field Simulation", ShaderX2, 2003). A
// nearer candidate counts if its own disc covers the centre. A candidate behind the centre counts only within
// the smaller of the two discs, so that a pixel in focus takes no colour from the background. Weight: 1/area
// of the deciding disc.
#include "baselines/baseline.h"

#include <numbers>

namespace petzval::baselines {
namespace {

constexpr int kBlock = 16;

// The largest radius in each block of kBlock x kBlock pixels.
Plane block_radii(View<const float> coc_px) {
    Plane most((coc_px.width() + kBlock - 1) / kBlock, (coc_px.height() + kBlock - 1) / kBlock);
    for (int y = 0; y < coc_px.height(); ++y)
        for (int x = 0; x < coc_px.width(); ++x) {
            float& m = most(x / kBlock, y / kBlock);
            m = std::max(m, std::abs(coc_px(x, y)));
        }
    return most;
}

// The search radius for the pixels of this block: the largest radius among blocks whose pixels could reach
// it.
int reach_of_block(const Plane& most, int bx, int by) {
    float reach = 0;
    for (int y = 0; y < most.height(); ++y)
        for (int x = 0; x < most.width(); ++x) {
            const int apart = std::max(std::abs(x - bx), std::abs(y - by));
            if (most(x, y) + 1 >= float((apart - 1) * kBlock)) reach = std::max(reach, most(x, y));
        }
    return int(std::ceil(reach));
}

// Share of a pixel at this distance that a disc covers, one pixel soft at its rim.
float covers(float radius_px, float distance_px) {
    return std::clamp(radius_px + 0.5f - distance_px, 0.0f, 1.0f);
}

Rgba gathered(const Input& input, int x, int y, int reach) {
    const float own = input.coc_px(x, y);
    Rgba sum{};
    float weights = 0;
    const Rect window =
        Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(input.colour.rect());
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            const float candidate = input.coc_px(u, v);
            const float decides =
                candidate < own ? std::abs(candidate) : std::min(std::abs(candidate), std::abs(own));
            const float radius = std::max(decides, 0.5f);
            const float distance = std::hypot(float(u - x), float(v - y));
            if (distance > radius + 0.5f) continue;
            const float weight = covers(radius, distance) / (std::numbers::pi_v<float> * radius * radius);
            sum += weight * input.colour(u, v);
            weights += weight;
        }
    return sum * (1 / weights);
}

}  // namespace

Picture gather(const Input& input) {
    Picture out(input.colour.width(), input.colour.height());
    const Plane most = block_radii(input.coc_px);
    in_parallel(most.width() * most.height(), input.threads, [&](int i) {
        const int bx = i % most.width(), by = i / most.width(), reach = reach_of_block(most, bx, by);
        const Rect block =
            Rect{bx * kBlock, by * kBlock, (bx + 1) * kBlock, (by + 1) * kBlock}.intersected(out.rect());
        for (int y = block.y0; y < block.y1; ++y)
            for (int x = block.x0; x < block.x1; ++x) out(x, y) = gathered(input, x, y, reach);
    });
    return out;
}

}  // namespace petzval::baselines
