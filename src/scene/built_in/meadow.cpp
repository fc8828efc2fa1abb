// A meadow from a hand above the ground: blades of grass one behind the other from before the lens to the
// horizon, none belonging to another, flowers between them, sky above. No pixel of it is a single surface.
#include "scene/built_in/plants.h"
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

#include <array>

namespace petzval::scene {
namespace {

constexpr float kEyeHeight = 0.30f, kFocus = 1.25f, kHalfWidth = 18.0f / 50;

float share(int i, int what, std::uint32_t seed) { return cell_value(i, what, seed); }

// Position of plant `i` of a band, spread over the band as seen from the first frame.
Vec3 place(int i, float near, float far, std::uint32_t seed) {
    const float z = near * std::pow(far / near, share(i, 0, seed));
    return {1.25f * kHalfWidth * z * (2 * share(i, 1, seed) - 1), 0, z};
}

// A curved blade that bends towards one side, its own way.
void add_blade(Tubes& grass, Vec3 root, float height, float width, int i, std::uint32_t seed) {
    const float heading = 2 * kPi * share(i, 3, seed), bend = height * (0.15f + 0.65f * share(i, 4, seed));
    const Vec3 aside{bend * std::cos(heading) + 0.10f * height, 0, 0.6f * bend * std::sin(heading)};
    std::vector<Vec3> through;
    for (int k = 0; k <= 3; ++k) {
        const float t = float(k) / 3;
        through.push_back(root + t * t * aside + Vec3{0, height * (t - 0.22f * t * t * t), 0});
    }
    grass.curve(through, 3, width, 0.15f * width);
}

Matter blade_paint(const SurfacePoint& p) {
    const Vec3 q = p.position;
    const float low = 0.30f + 0.70f * smoothstep(0.0f, 0.22f, q.y);  // it is dark near the ground
    const float dry = smoothstep(0.15f, 0.6f, noise({9 * q.x, 2.5f * q.y, 9 * q.z}));
    const Vec3 green = mix(Vec3{0.13f, 0.26f, 0.05f}, Vec3{0.30f, 0.42f, 0.10f},
                           0.5f + 0.5f * noise({23 * q.x, 3 * q.y, 23 * q.z}));
    return {low * mix(green, Vec3{0.52f, 0.46f, 0.20f}, 0.8f * dry), {}};
}

void add_grass(World& world) {
    struct Band {
        float near, far;
        int count;
        float height, width;
    };
    // Few near the lens, where one hides much; the farther, the more.
    const Band bands[] = {{0.34f, 0.70f, 48, 0.46f, 0.0042f},
                          {0.70f, 1.6f, 330, 0.30f, 0.0014f},
                          {1.6f, 4.5f, 1500, 0.30f, 0.0018f},
                          {4.5f, 14, 2600, 0.33f, 0.0035f},
                          {14, 40, 1500, 0.40f, 0.010f}};
    std::uint32_t seed = 601;
    Tubes grass;
    for (const Band& band : bands) {
        ++seed;
        for (int i = 0; i < band.count; ++i)
            add_blade(grass, place(i, band.near, band.far, seed),
                      band.height * (0.45f + 0.7f * share(i, 2, seed)),
                      band.width * (0.7f + 0.6f * share(i, 5, seed)), i, seed);
    }
    world.add(std::move(grass), blade_paint);
}

// Parts of flowers, all of a kind in one mesh.
struct Flowers {
    Mesh poppies, daisies, cornflowers, hearts;
    Tubes stems, ears;
};

// Petals in a ring, tilted up by `cup` of their length.
void ring(Mesh& mesh, Vec3 at, int petals, float length, float cup, float half_width, float turn) {
    for (int k = 0; k < petals; ++k) {
        const float a = turn + 2 * kPi * float(k) / float(petals);
        const Vec3 out{std::cos(a), 0, std::sin(a)};
        mesh.append(leaf(at, at + length * (out + Vec3{0, cup, 0}), {0, 1, 0}, half_width, 4));
    }
}

void add_flower(Flowers& flowers, int i) {
    constexpr std::uint32_t kSeed = 631;
    const Vec3 root = place(i, 0.62f, 7.5f, kSeed);
    const float height = 0.17f + 0.20f * share(i, 2, kSeed), size = 0.8f + 0.5f * share(i, 3, kSeed);
    const Vec3 lean{0.09f * (share(i, 4, kSeed) - 0.3f), 0, 0.08f * (share(i, 5, kSeed) - 0.5f)};
    const Vec3 head = root + lean + Vec3{0, height, 0};
    flowers.stems.curve({root, root + 0.4f * lean + Vec3{0, 0.6f * height, 0}, head}, 4, 0.0016f, 0.0011f);
    const float turn = 6.3f * share(i, 6, kSeed);
    switch (int(4 * share(i, 7, kSeed))) {
        case 0:
        case 1:
            ring(flowers.poppies, head, 4, 0.030f * size, 0.75f, 0.024f * size, turn);
            flowers.hearts.append(sphere(head + Vec3{0, 0.008f, 0}, {0.006f, 0.008f, 0.006f}, 10, 6));
            break;
        case 2:
            ring(flowers.daisies, head, 13, 0.021f * size, 0.15f, 0.0048f * size, turn);
            flowers.hearts.append(sphere(head, {0.007f * size, 0.005f, 0.007f * size}, 10, 6));
            break;
        default:
            ring(flowers.cornflowers, head, 9, 0.018f * size, 0.6f, 0.006f * size, turn);
            ring(flowers.cornflowers, head, 6, 0.012f * size, 1.6f, 0.004f * size, turn + 0.3f);
    }
}

void add_flowers(World& world) {
    constexpr int kFlowers = 120, kEars = 90;
    Flowers flowers;
    for (int i = 0; i < kFlowers; ++i) add_flower(flowers, i);
    for (int i = 0; i < kEars; ++i) {  // grass in seed
        const Vec3 root = place(i, 0.55f, 6, 641);
        const Vec3 top = root + Vec3{0.10f * (share(i, 2, 641) - 0.3f), 0.30f + 0.14f * share(i, 3, 641), 0};
        flowers.stems.line(root, top, 0.0009f);
        flowers.ears.path({top, top + Vec3{0.012f, 0.035f, 0}, top + Vec3{0.03f, 0.06f, 0}}, 0.0034f,
                          0.0012f);
    }
    const auto petals = [](Vec3 inner, Vec3 outer) {
        return [=](const SurfacePoint& p) {
            return Matter{mix(inner, outer, smoothstep(0.1f, 0.5f, p.v)), {}};
        };
    };
    world.add(std::move(flowers.poppies), petals({0.12f, 0.01f, 0.01f}, {0.80f, 0.09f, 0.03f}), Sides::Leaf);
    world.add(std::move(flowers.daisies), petals({0.72f, 0.66f, 0.40f}, {0.84f, 0.83f, 0.80f}), Sides::Leaf);
    world.add(std::move(flowers.cornflowers), petals({0.16f, 0.06f, 0.42f}, {0.14f, 0.22f, 0.78f}),
              Sides::Leaf);
    world.add(
        std::move(flowers.hearts),
        [](const SurfacePoint&) {
            return Matter{{0.74f, 0.50f, 0.06f}, {}};
        },
        Sides::Solid);
    world.add(std::move(flowers.stems), [](const SurfacePoint& p) {
        return Matter{(0.35f + 0.65f * smoothstep(0, 0.2f, p.position.y)) * Vec3{0.20f, 0.30f, 0.09f}, {}};
    });
    world.add(std::move(flowers.ears), [](const SurfacePoint& p) {
        return Matter{(1 + 0.3f * noise(400.0f * p.position)) * Vec3{0.46f, 0.40f, 0.18f}, {}};
    });
}

Matter ground(const SurfacePoint& p) {
    const Vec3 q = p.position;
    const float far = smoothstep(6, 40, q.z);
    const float tuft = fractal_noise({6 * q.x, 0, 2.5f * q.z}, 3), swathe = fractal_noise(0.12f * q, 3);
    const Vec3 near = Vec3{0.075f, 0.10f, 0.03f} * (1 + 0.5f * tuft);
    const Vec3 away = mix(Vec3{0.20f, 0.30f, 0.07f}, Vec3{0.44f, 0.42f, 0.14f}, 0.5f + 0.5f * swathe);
    return {mix(near, away * (1 + 0.2f * tuft), far), {}};
}

void add_distance(World& world) {
    for (int i = 0; i < 26; ++i) {  // a hedge and single trees
        const auto random = [i](int what) { return cell_value(i, what, 651); };
        const float z = 70 + 40 * random(0), x = 0.5f * z * (2 * random(1) - 1);
        const float size = (1.6f + 2.6f * random(2)) * (i % 5 == 0 ? 1.6f : 1);
        world.add(
            bush({x, 0.75f * size, z}, {1.3f * size, size, size}, 0.35f),
            [](const SurfacePoint& p) {
                const float tuft = smoothstep(-0.6f, 0.8f, fractal_noise(1.9f * p.position, 3));
                return Matter{mix(Vec3{0.04f, 0.09f, 0.04f}, Vec3{0.20f, 0.29f, 0.11f}, tuft), {}};
            },
            Sides::Solid);
    }
    world.add(
        patch({-220, 0, 160}, {440, 0, 0}, {0, 9, 12}, 40, 4),
        [](const SurfacePoint& p) {
            const float field = checks(p.position.x / 60 + 0.3f * p.v, 1.5f * p.v, 0.1f);
            return Matter{mix(Vec3{0.22f, 0.32f, 0.18f}, Vec3{0.46f, 0.42f, 0.22f}, field), {}};
        },
        Sides::Sheet);
}

void build(World& world, float time) {
    world.view = Viewpoint::looking({0.06f * time, kEyeHeight, 0}, {0.06f * time, kEyeHeight - 0.055f, 1});
    world.sky = [](Vec3 d) {
        const Vec3 q = d / std::max(d.z, 0.1f);
        const float cloud = smoothstep(0.0f, 0.7f, fractal_noise({5 * q.x + 1, 14 * q.y, 4}, 4));
        const Vec3 clear =
            mix(Vec3{0.80f, 0.88f, 0.95f}, Vec3{0.22f, 0.42f, 0.82f}, smoothstep(-0.02f, 0.3f, d.y));
        return mix(clear, Vec3{1.15f, 1.12f, 1.06f}, 0.85f * cloud);
    };
    world.ambient_above = {1.2f, 1.35f, 1.55f}, world.ambient_below = {0.30f, 0.34f, 0.16f};
    world.lights.push_back({{0.75f, 0.80f, 0.30f}, {2.9f, 2.6f, 2.1f}, 0.02f, true});
    world.add(patch({-80, 0, 0.2f}, {160, 0, 0}, {0, 0, 165}, 24, 80), ground, Sides::Sheet);
    add_grass(world);
    add_flowers(world);
    add_distance(world);
}

}  // namespace

BuiltInScene meadow() {
    return {{.name = "meadow",
             .purpose = "thin blades of grass from very near to far, flowers between them, sky",
             .camera =
                 {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.8, .focus_distance_m = kFocus},
             .frames = 48,
             .floor_m = 0},
            build};
}

}  // namespace petzval::scene
