// One printed sheet that rises from near the lens through the focus plane into the distance: the case where
// every pixel has another radius and there is no edge to hide behind.
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kCell = 0.14f;  // width of one printed motif, m; its length grows with its distance

// 0…1, how much ink motif `kind` puts at (x, y) of its cell, both -1…1.
float motif(int kind, float x, float y) {
    const float r = std::sqrt(x * x + y * y);
    switch (kind) {
        case 0:
            return smoothstep(0.62f, 0.58f, r);  // dot
        case 1:
            return stripes(2.5f * r, 0.5f, 0.1f) * smoothstep(0.9f, 0.86f, r);  // rings
        case 2:
            return stripes(2.5f * x + 0.25f, 0.45f, 0.08f) * smoothstep(0.8f, 0.76f, std::abs(y));
        case 3: {  // star of wedges
            const float wedge = std::atan2(y, x) * 8 / (2 * kPi);
            return stripes(wedge, 0.46f, 0.08f) * smoothstep(0.85f, 0.8f, r) * smoothstep(0.08f, 0.16f, r);
        }
        case 4:
            return smoothstep(0.66f, 0.62f, std::max(std::abs(x), std::abs(y))) *
                   (1 - smoothstep(0.36f, 0.32f, std::max(std::abs(x), std::abs(y))));  // frame
        default:
            return checks(2.5f * x + 0.25f, 2.5f * y + 0.25f, 0.08f) *
                   smoothstep(0.8f, 0.76f, std::max(std::abs(x), std::abs(y)));
    }
}

Matter sheet(const SurfacePoint& p) {
    static const Vec3 kPapers[] = {
        {0.75f, 0.70f, 0.60f}, {0.55f, 0.62f, 0.62f}, {0.70f, 0.52f, 0.36f}, {0.16f, 0.22f, 0.30f}};
    static const Vec3 kInks[] = {
        {0.05f, 0.06f, 0.09f}, {0.55f, 0.07f, 0.05f}, {0.04f, 0.20f, 0.36f}, {0.85f, 0.62f, 0.16f}};
    const float x = p.position.x / kCell, y = std::log(p.position.z) / kCell * 0.9f;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const float cx = 2 * (x - float(i)) - 1, cy = 2 * (y - float(j)) - 1;
    const int paper = int(4 * cell_value(i, j, 11)), kind = int(6 * cell_value(i, j, 23));
    int ink = int(4 * cell_value(i, j, 37));
    if (paper == 3) ink = 3;
    const float grain = 1 + 0.08f * noise(90.0f * p.position) + 0.12f * fractal_noise(1.7f * p.position, 3);
    return {grain * mix(kPapers[paper], kInks[ink], motif(kind, cx, cy)), {}};
}

void build(World& world, float) {
    // Depth z is reached at height 0.1875 z - 0.375: 1/z runs linearly from 0.83 at the lower edge of a 16:9
    // frame to 0.17 at its upper edge.
    world.ambient_above = {0.5f, 0.55f, 0.65f}, world.ambient_below = {0.2f, 0.2f, 0.2f};
    world.sky = [](Vec3) { return Vec3{0.24f, 0.26f, 0.30f}; };
    world.lights.push_back({{-2.5f, 4.5f, 1.5f}, {42, 38, 32}, 0.3f});
    const float near = 0.5f, far = 40;
    const auto height = [](float z) { return 0.1875f * z - 0.375f; };
    world.add(
        patch({-12, height(near), near}, {24, 0, 0}, {0, height(far) - height(near), far - near}, 60, 120),
        sheet, Sides::Sheet);
}

}  // namespace

BuiltInScene slant() {
    return {
        {.name = "slant",
         .purpose = "one textured plane through focus: every pixel has its own radius, nothing is hidden",
         .camera = {.focal_length_mm = 85, .sensor_width_mm = 36, .f_number = 1.4, .focus_distance_m = 2}},
        build};
}

}  // namespace petzval::scene
