// A town at night: a bicycle in focus on the wet quay, twigs near the lens, and some three hundred lamps at
// every distance behind. This is the picture that shows what a lens does to lights, so the lamps are as
// bright as real ones (radiance 20…2000 where the lit ground is 0.02).
#include "scene/built_in/bicycle.h"
#include "scene/built_in/plants.h"
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

#include <array>

namespace petzval::scene {
namespace {

constexpr float kEyeHeight = 0.69f;  // m

namespace light {
constexpr Vec3 kSodium{1, 0.50f, 0.13f}, kWarm{1, 0.72f, 0.40f}, kWhite{1, 0.90f, 0.76f},
    kCool{0.62f, 0.80f, 1};
constexpr Vec3 kRed{1, 0.06f, 0.03f}, kGreen{0.08f, 1, 0.42f}, kAmber{1, 0.42f, 0.04f};
constexpr Vec3 kPink{1, 0.10f, 0.42f}, kCyan{0.06f, 0.70f, 1}, kViolet{0.42f, 0.16f, 1};
}  // namespace light

// The street runs away from the viewer, a little to the left.
float street(float across, float z) { return across - 0.075f * (z - 8); }

class City {
public:
    explicit City(World& world) : world_(world) {}

    // A lamp that fills its disc, once far out of focus, with about `glow` (1 is white); its reflection too.
    void lamp(Vec3 at, float radius_m, Vec3 colour, float glow) {
        const float image_radius = radius_m / at.z / kPixel;  // px, and that of its circle of confusion:
        const float blur = kBlurAtInfinity * (1 - kFocus / at.z);
        const float radiance = glow * blur * blur / (image_radius * image_radius);
        world_.add_lamp(at, radius_m, std::min(radiance, 2500.0f) * colour);
        reflections_.push_back({at, glow * blur * blur * kPixel * kPixel * kPi * colour});
    }
    float random(int what) { return cell_value(count_++, what, 2027); }

    // A place on the wet ground where lamps glitter, seen from the first frame; see ground_glow().
    struct Reflection {
        Vec3 lamp, power;  // power: radiance times solid angle, small-angle units
    };
    const std::vector<Reflection>& reflections() const { return reflections_; }

    static constexpr float kPixel = 36.0f / 960 / 105, kFocus = 4.8f, kBlurAtInfinity = 21.9f;

private:
    World& world_;
    std::vector<Reflection> reflections_;
    int count_ = 0;
};

void add_street_lamps(City& city) {
    for (int i = 0; i < 9; ++i) {
        const float z = 34 + 13 * float(i);
        city.lamp({street(-5.2f, z), 4.9f, z}, 0.05f, light::kSodium, 1.2f);
        city.lamp({street(5.4f, z + 5), 4.9f, z + 5}, 0.05f, light::kSodium, 1.0f);
    }
    for (int i = 0; i < 6; ++i) {  // lanterns along the quay
        const float z = 15 + 5.5f * float(i);
        city.lamp({street(3.4f, z), 2.15f, z}, 0.035f, light::kWarm, 1.3f);
        if (i > 0) city.lamp({street(-2.6f, z - 2), 2.3f, z - 2}, 0.035f, light::kWhite, 1.1f);
    }
}

void add_traffic(City& city) {
    city.lamp({1.95f, 1.95f, 19}, 0.05f, light::kRed, 1.8f);
    city.lamp({street(-2.9f, 27), 2.7f, 27}, 0.05f, light::kGreen, 1.5f);
    city.lamp({street(4.6f, 38), 3.2f, 38}, 0.06f, light::kGreen, 1.3f);
    city.lamp({street(-3.6f, 52), 3.6f, 52}, 0.06f, light::kRed, 1.5f);
    city.lamp({street(0.6f, 66), 3.9f, 66}, 0.06f, light::kAmber, 1.2f);
    for (int i = 0; i < 9; ++i) {
        const float z = 24 + 9.5f * float(i) + 4 * city.random(0), lane = 1.9f + 0.5f * city.random(1);
        const float height = 0.6f + 0.12f * city.random(2), half = 0.62f + 0.1f * city.random(3);
        for (const float side : {-half, half}) {
            if (i % 2 == 0)
                city.lamp({street(-lane + side, z), height, z}, 0.06f,
                          mix(light::kWhite, light::kCool, city.random(4)), 1.7f);
            else
                city.lamp({street(lane + side, z), height + 0.15f, z}, 0.05f, light::kRed, 0.9f);
        }
    }
}

// Strings of small bulbs over the quay.
void add_strings(City& city) {
    const Vec3 ends[][2] = {{{-2.1f, 1.75f, 11}, {0.4f, 1.85f, 13.5f}},
                            {{0.4f, 1.85f, 13.5f}, {2.6f, 1.7f, 10.5f}},
                            {{-2.6f, 1.45f, 14.5f}, {3.1f, 2.05f, 16.5f}}};
    int string = 0;
    for (const auto& [from, to] : ends) {
        const int bulbs = 15;
        for (int i = 0; i <= bulbs; ++i) {
            const float t = float(i) / bulbs;
            Vec3 p = mix(from, to, t);
            p.y -= 4 * 0.28f * t * (1 - t);
            city.lamp(p, 0.008f,
                      string == 2 ? mix(light::kWarm, light::kAmber, city.random(5)) : light::kWarm,
                      0.28f + 0.35f * city.random(6));
        }
        ++string;
    }
}

// Signs of glowing tube: rows of points that melt into strokes.
void add_signs(City& city) {
    const auto stroke = [&](Vec3 a, Vec3 b, Vec3 colour, float glow) {
        for (int i = 0; i < 9; ++i) city.lamp(mix(a, b, float(i) / 8), 0.03f, colour, glow);
    };
    stroke({street(6.3f, 40), 1.7f, 40}, {street(6.3f, 40), 4.0f, 40}, light::kPink, 0.32f);
    stroke({street(-5.9f, 48), 2.2f, 48}, {street(-4.2f, 48), 2.2f, 48}, light::kCyan, 0.28f);
    stroke({street(6.5f, 62), 3.2f, 62}, {street(4.6f, 62), 3.2f, 62}, light::kViolet, 0.30f);
    stroke({street(-6.2f, 70), 3.0f, 70}, {street(-6.2f, 70), 6.0f, 70}, light::kPink, 0.25f);
}

// The far side of the harbour.
void add_far_lights(City& city) {
    const Vec3 colours[] = {light::kSodium, light::kWarm, light::kWhite, light::kSodium,
                            light::kCool,   light::kWarm, light::kAmber, light::kCyan};
    for (int i = 0; i < 130; ++i) {
        const float z = 48 + 60 * city.random(7);
        const float x = 0.185f * z * (2 * city.random(8) - 1);
        const float rise = city.random(9);
        const float y = kEyeHeight + z * (0.002f + 0.075f * rise * rise);
        const float faint = city.random(10);
        city.lamp({x, y, z}, 0.045f, colours[int(8 * city.random(11))],
                  0.04f + 0.8f * faint * faint * faint * faint);
    }
}

// Lit and dark windows of a wall, metres along and up.
Vec3 windows(float along, float up, int house) {
    const float x = along / 1.9f, y = up / 3.1f;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const float pane = smoothstep(0.24f, 0.28f, x - float(i)) * smoothstep(0.76f, 0.72f, x - float(i)) *
                       smoothstep(0.28f, 0.31f, y - float(j)) * smoothstep(0.80f, 0.77f, y - float(j));
    const std::uint32_t seed = std::uint32_t(91 + house);
    if (j == 0 || cell_value(i, j, seed) > 0.36f) return pane * Vec3{0.004f, 0.006f, 0.010f};
    const float strength = 0.05f + 0.5f * cell_value(i, j, seed + 7) * cell_value(j, i, seed + 9);
    return strength * pane *
           mix(Vec3{1, 0.62f, 0.28f}, Vec3{0.75f, 0.88f, 1},
               smoothstep(0.6f, 0.8f, cell_value(i, j, seed + 3)));
}

void add_houses(World& world) {
    for (int i = 0; i < 26; ++i) {
        const float z = 112 + 5.2f * float(i), width = 0.05f * z + 4 * cell_value(i, 0, 17);
        const float x = 0.2f * z * (2 * cell_value(i, 1, 17) - 1),
                    height = z * (0.025f + 0.060f * cell_value(i, 2, 17));
        world.add(
            patch({x - width, 0, z}, {2 * width, 0, 0}, {0, height, 0}, 4, 4),
            [=](const SurfacePoint& p) {
                const Vec3 wall =
                    mix(Vec3{0.06f, 0.05f, 0.05f}, Vec3{0.05f, 0.06f, 0.09f}, cell_value(i, 3, 17));
                return Matter{wall, windows(p.position.x - x + 100, p.position.y, i)};
            },
            Sides::Sheet);
    }
}

// Reflections on the wet ground as the first frame's viewer sees them, painted on: a table over (x/z, 1/z),
// in which a streak has the same size wherever it lies.
class GroundGlow {
public:
    explicit GroundGlow(const City& city) : texels_(std::size_t(kWidth) * kHeight) {
        for (const City::Reflection& r : city.reflections()) add(r);
    }
    Vec3 at(Vec3 p) const {
        const float x = (p.x / p.z / kHalfWidth * 0.5f + 0.5f) * kWidth - 0.5f;
        const float y = kEyeHeight / p.z / kDepth * kHeight - 0.5f;
        if (x < 0 || y < 0 || x >= kWidth - 1 || y >= kHeight - 1) return {};
        const int i = int(x), j = int(y);
        const auto row = [&](int k) { return mix(texel(i, k), texel(i + 1, k), x - float(i)); };
        return mix(row(j), row(j + 1), y - float(j));
    }

private:
    static constexpr int kWidth = 900, kHeight = 300;
    static constexpr float kHalfWidth = 0.25f, kDepth = 0.13f;  // tangents
    Vec3 texel(int i, int j) const { return texels_[std::size_t(j) * kWidth + std::size_t(i)]; }

    void add(const City::Reflection& r) {
        constexpr float kAcross = 0.0026f, kAbove = 0.010f, kBelow = 0.030f;  // widths of a streak, tangents
        constexpr float kReflected = 0.55f;
        const float x = r.lamp.x / r.lamp.z, y = (kEyeHeight + r.lamp.y) / r.lamp.z;
        const Vec3 peak = kReflected / (2 * kPi * kAcross * 0.5f * (kAbove + kBelow)) * r.power;
        for (int j = 0; j < kHeight; ++j)
            for (int i = 0; i < kWidth; ++i) {
                const float dx = ((float(i) + 0.5f) / kWidth * 2 - 1) * kHalfWidth - x;
                const float ty = (float(j) + 0.5f) / kHeight * kDepth, dy = ty - y;
                const float a = dx / kAcross, b = dy / (dy < 0 ? kAbove : kBelow);
                if (a * a + b * b > 16) continue;
                // Ripples: bands across the view, finer towards the horizon.
                const float ripple =
                    0.5f +
                    0.9f * std::max(0.0f, 0.3f + noise({60 * dx + 7 * x, 9 * std::log(ty) * 3, 100 * x}));
                texels_[std::size_t(j) * kWidth + std::size_t(i)] +=
                    ripple * std::exp(-0.5f * (a * a + b * b)) * peak;
            }
    }

    std::vector<Vec3> texels_;
};

void add_ground(World& world, const City& city) {
    auto glow = std::make_shared<GroundGlow>(city);
    world.add(
        patch({-40, 0, 1}, {80, 0, 0}, {0, 0, 240}, 40, 160),
        [glow](const SurfacePoint& p) {
            // Setts, darker where water stands.
            const Brick sett = brick(p.position.x / 0.16f, p.position.z / 0.12f, 0.12f, 0.14f);
            const float fade = smoothstep(14, 7, p.position.z), joint = sett.mortar * fade;
            const float wet = smoothstep(-0.2f, 0.5f, fractal_noise(0.55f * p.position, 2));
            const Vec3 stone =
                Vec3{0.085f, 0.08f, 0.078f} * (0.75f + 0.5f * fade * cell_value(sett.column, sett.row, 3));
            return Matter{stone * (1 - 0.7f * joint) * (1 - 0.45f * wet),
                          glow->at(p.position) * ((0.35f + 0.65f * wet) * (1 - 0.6f * joint))};
        },
        Sides::Sheet);
}

// Bollards with a chain between them, a lamp post and the trunks of two trees: dark shapes that cut the
// lights.
void add_quay(World& world) {
    Tubes iron, trunks;
    float previous = 0;
    for (int i = 0; i < 4; ++i) {
        const float x = -1.75f + 1.15f * float(i), z = 7.0f + 0.35f * float(i);
        iron.path({{x, 0, z}, {x, 0.1f, z}, {x, 0.62f, z}, {x, 0.68f, z}}, 0.062f, 0.045f);
        iron.line({x, 0.74f, z}, {x, 0.745f, z}, 0.055f);
        if (i > 0) {
            std::vector<Vec3> chain;
            for (int k = 0; k <= 20; ++k) {
                const float t = float(k) / 20;
                chain.push_back({mix(previous, x, t), 0.62f - 0.72f * t * (1 - t), z - 0.35f * (1 - t)});
            }
            iron.path(chain, 0.011f, 0.011f);
        }
        previous = x;
    }
    iron.path({{-1.02f, 0, 8.6f}, {-1.02f, 3, 8.6f}}, 0.045f, 0.03f);
    trunks.path({{1.52f, 0, 11.5f}, {1.46f, 0.9f, 11.5f}, {1.55f, 1.7f, 11.6f}, {1.5f, 2.6f, 11.6f}}, 0.15f,
                0.09f);
    trunks.path({{1.55f, 1.45f, 11.6f}, {1.9f, 1.8f, 11.5f}, {2.3f, 2.0f, 11.3f}}, 0.05f, 0.03f);
    trunks.path({{-2.3f, 0, 16.5f}, {-2.2f, 1.2f, 16.5f}, {-2.35f, 2.9f, 16.5f}}, 0.16f, 0.1f);
    trunks.path({{-2.22f, 1.3f, 16.5f}, {-1.7f, 1.9f, 16.4f}, {-1.4f, 2.4f, 16.4f}}, 0.05f, 0.03f);
    world.add(std::move(iron), [](const SurfacePoint&) { return Matter{{0.05f, 0.05f, 0.055f}, {}}; });
    world.add(std::move(trunks), [](const SurfacePoint&) { return Matter{{0.07f, 0.055f, 0.045f}, {}}; });
}

void build(World& world, float time) {
    world.view.position = {0.12f * time, kEyeHeight, 0};
    world.sky = [](Vec3 d) {
        const float rise = std::max(0.0f, d.y / std::max(d.z, 0.05f));
        return mix(Vec3{0.085f, 0.050f, 0.050f}, Vec3{0.012f, 0.026f, 0.070f}, smoothstep(0, 0.10f, rise));
    };
    world.ambient_above = {0.030f, 0.036f, 0.055f}, world.ambient_below = {0.016f, 0.012f, 0.010f};
    world.lights.push_back({{-2.4f, 3.2f, 2.9f}, {24, 15, 8.2f}, 0.12f});       // the lamp over the quay
    world.lights.push_back({{2.9f, 1.9f, 7.3f}, {10.5f, 3.2f, 6.4f}, 0.2f});    // a sign behind, to the right
    world.lights.push_back({{-3.4f, 2.2f, 7.8f}, {2.4f, 5.4f, 8.0f}, 0.2f});    // and a cold one to the left
    world.lights.push_back({{-1.1f, 1.5f, 0.5f}, {1.5f, 1.15f, 0.75f}, 0.1f});  // a shop window behind us
    City city(world);
    add_street_lamps(city);
    add_traffic(city);
    add_strings(city);
    add_signs(city);
    add_far_lights(city);
    add_houses(world);
    add_ground(world, city);
    add_quay(world);
    const Vec3 forward = normalised(Vec3{0.76f, 0, -0.65f});
    add_bicycle(world, {Vec3{0.20f, 0, City::kFocus} - 0.83f * forward, forward});
    const Foliage autumn{{0.06f, 0.045f, 0.035f}, {0.30f, 0.20f, 0.035f}, {0.13f, 0.19f, 0.05f}, 0.04f};
    add_twig(world, {-0.36f, 0.83f, 1.55f}, {-0.10f, 0.72f, 1.75f}, 12, autumn, 1);
    add_twig(world, {-0.33f, 0.74f, 1.45f}, {-0.19f, 0.60f, 1.60f}, 9, autumn, 2);
    add_twig(world, {0.40f, 0.80f, 1.9f}, {0.24f, 0.775f, 2.0f}, 8, autumn, 3);
}

}  // namespace

BuiltInScene night() {
    return {{.name = "night",
             .purpose = "hundreds of HDR lamps at many depths behind a bicycle in focus, twigs near the lens",
             .camera = {.focal_length_mm = 105,
                        .sensor_width_mm = 36,
                        .f_number = 1.4,
                        .focus_distance_m = City::kFocus},
             .frames = 48,
             .floor_m = 0},
            build};
}

}  // namespace petzval::scene
