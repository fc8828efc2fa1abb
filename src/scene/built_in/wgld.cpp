// The tori of wgld.org's article on depth of field, shaded after it: a texture, a diffuse share of at least
// 0.1, a half-vector highlight of power 50, an ambient term (docs/explain/published-gaussian.md says what
// differs); from near 0.1 to far 30.
#include "scene/built_in/scenes.h"
#include "scene/shading.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kFocus = 8;
const Vec3 kLight = normalised({-0.5f, 0.7f, -0.6f});

Vec3 texture_at(const SurfacePoint& p, int kind) {
    const float t =
        kind % 2 == 0 ? checks(20 * p.u, 8 * p.v, 0.06f) : stripes(14 * p.u + 2 * p.v, 0.5f, 0.06f);
    return mix(Vec3{0.25f, 0.25f, 0.28f}, Vec3{1, 0.98f, 0.94f}, t) * (1 + 0.1f * noise(12.0f * p.position));
}

Paint shaded(int kind, Vec3 colour) {
    return [=](const SurfacePoint& p) {
        constexpr Vec3 kAmbient{0.08f, 0.08f, 0.09f};
        const Vec3 normal = normalised(p.normal), half = normalised(kLight - p.direction);
        const float diffuse = std::clamp(dot(normal, kLight), 0.1f, 1.0f);
        const float specular = std::pow(std::clamp(dot(normal, half), 0.0f, 1.0f), 50.0f);
        return Matter{
            {},
            texture_at(p, kind) * colour * diffuse + Vec3{specular, specular, specular} + colour * kAmbient};
    };
}

void build(World& world, float time) {
    static const Vec3 kColours[] = {{0.90f, 0.25f, 0.16f},
                                    {0.92f, 0.70f, 0.18f},
                                    {0.22f, 0.66f, 0.30f},
                                    {0.16f, 0.50f, 0.85f},
                                    {0.62f, 0.26f, 0.72f}};
    world.is_baked = false;
    world.sky = [](Vec3 d) {
        return mix(Vec3{0.02f, 0.03f, 0.05f}, Vec3{0.10f, 0.12f, 0.18f}, 0.5f + 0.5f * normalised(d).y);
    };
    constexpr int kCount = 11;
    for (int i = 0; i < kCount; ++i) {
        // Even steps of 1/depth from 2.5 to 29 m, on a spiral that fills the frame.
        const float z = 1 / mix(1 / 2.5f, 1 / 29.0f, float(i) / (kCount - 1));
        const float turn = 2.4f * float(i), out = i == 0 ? 0.20f : 0.21f * std::sqrt(1 - 0.06f * float(i));
        const float spin = 2 * kPi * (time + cell_value(i, 1, 741)), size = 0.13f * std::pow(z, 0.72f);
        const Vec3 at{out * 1.25f * std::cos(turn) * z, out * 0.72f * std::sin(turn) * z, z};
        world.add(
            torus(at, normalised(Vec3{std::cos(spin), 0.5f, std::sin(spin)}), size, 0.4f * size, 64, 32),
            shaded(i, kColours[i % 5]), Sides::Solid);
    }
}

}  // namespace

// A camera of large format, so that metres blur as the article's units do.
BuiltInScene wgld() {
    return {
        {.name = "wgld",
         .purpose = "the textured tori of wgld.org's article, depth 0.1 to 30, with the article's shading",
         .camera =
             {.focal_length_mm = 300, .sensor_width_mm = 216, .f_number = 1.4, .focus_distance_m = kFocus},
         .frames = 48},
        build};
}

}  // namespace petzval::scene
