// Someone with wind in the hair, seen from behind, before a park in the sun: hundreds of strands one to two
// pixels wide (at 640), in focus, each before something bright and far out of focus; leaves close to the lens
// at the frame's edge. Most pixels of the hair hold several depths, and none of them is clean.
#include "scene/built_in/park.h"
#include "scene/built_in/plants.h"
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kEyeHeight = 1.50f, kHead = 1.5f;  // m; the second is the distance
constexpr Vec3 kSkull{-0.050f, 1.545f, kHead}, kSkullRadii{0.074f, 0.100f, 0.088f};

// A number of strand `i`, 0…1 or -1…1.
float share(int i, int what) { return cell_value(i, what, 4711); }
float either(int i, int what) { return 2 * share(i, what) - 1; }

Vec3 hair_colour(Vec3 p) {
    const float tint = 0.5f + 0.5f * noise({70 * p.x + 9 * p.y, 5 * p.y, 60 * p.z});
    // Hair shines where it bends over the head.
    const float across =
        (p.y - kSkull.y - 0.048f + 0.35f * (p.x - kSkull.x) * (p.x - kSkull.x) / 0.1f) / 0.022f;
    const float sheen = std::exp(-across * across);
    return mix(Vec3{0.15f, 0.065f, 0.026f}, Vec3{0.44f, 0.23f, 0.10f}, tint * tint) * (1 + 1.1f * sheen);
}

// Out of the skull, if p lies in it.
Vec3 outside_skull(Vec3 p, float margin) {
    const Vec3 from = p - kSkull;
    const Vec3 scaled{from.x / kSkullRadii.x, from.y / kSkullRadii.y, from.z / kSkullRadii.z};
    const float inside = length(scaled);
    return inside >= margin ? p : kSkull + from * (margin / inside);
}

struct Strand {
    Vec3 root, direction;
    float length_m = 0, lift = 0, wind = 0, wave = 0, phase = 0;
};

// Down along the head, then free: it falls, and the wind takes its end to the right.
std::vector<Vec3> flow(const Strand& strand) {
    constexpr int kSteps = 22;
    const float step = strand.length_m / kSteps;
    std::vector<Vec3> through{strand.root};
    Vec3 p = strand.root, direction = strand.direction;
    for (int k = 0; k < kSteps; ++k) {
        const float t = float(k) / kSteps;
        const Vec3 pull{strand.wind * (0.15f + 1.3f * t), -1 + 0.75f * strand.wind * t, 0.1f * strand.lift};
        direction = normalised(direction + 0.32f * pull);
        const float turn = strand.phase + 11 * t;
        p += step * direction + strand.wave * step * Vec3{std::sin(turn), 0, std::cos(1.3f * turn)};
        p = outside_skull(p, 1.02f + 0.10f * strand.lift);
        through.push_back(p);
    }
    return through;
}

// The root of a strand on the head; azimuth 0 is towards the viewer, polar 0 upwards.
Strand rooted(float azimuth, float polar) {
    const Vec3 out{std::sin(azimuth) * std::sin(polar), std::cos(polar),
                   -std::cos(azimuth) * std::sin(polar)};
    return {.root = kSkull + 1.03f * out * kSkullRadii, .direction = normalised(out - Vec3{0, 0.6f, 0})};
}

// Locks of strands that lie apart at the root and draw together towards their end.
void add_locks(Tubes& hair) {
    constexpr int kLocks = 96, kStrands = 11;
    for (int lock = 0; lock < kLocks; ++lock) {
        const bool back = lock % 3 != 0;  // most are on the side that is seen
        const float azimuth = (back ? 1.4f : kPi) * either(lock, 0);
        const float polar = 0.02f + (back ? 1.75f : 1.2f) * share(lock, 1);
        Strand strand = rooted(azimuth, polar);
        strand.length_m = 0.24f + 0.09f * share(lock, 2);
        strand.lift = 0.05f + 0.35f * share(lock, 3);
        strand.wind = 0.02f + 0.45f * share(lock, 4) * share(lock, 4);
        strand.wave = 0.10f + 0.16f * share(lock, 5);
        strand.phase = 6.3f * share(lock, 6);
        const std::vector<Vec3> axis = flow(strand);
        for (int i = 0; i < kStrands; ++i) {
            const int id = 1000 + lock * kStrands + i;
            const Strand root = rooted(azimuth + 0.17f * either(id, 0), polar + 0.13f * either(id, 1));
            strand.root = root.root, strand.direction = root.direction;
            strand.phase += 0.25f * either(id, 6);
            std::vector<Vec3> through = flow(strand);
            const float drawn = 0.35f + 0.5f * share(id, 5);
            for (std::size_t k = 0; k < through.size(); ++k)
                through[k] = mix(through[k], axis[k], drawn * float(k) / float(through.size() - 1));
            hair.curve(through, 2, 0.0009f, 0.0005f);
        }
    }
}

// Single strands that the wind has taken out of the locks.
void add_flyaways(Tubes& hair) {
    constexpr int kCount = 110;
    for (int i = 0; i < kCount; ++i) {
        const int id = 9000 + i;
        Strand strand = rooted(kPi * either(id, 0), 0.15f + 1.25f * share(id, 1));
        strand.length_m = 0.12f + 0.24f * share(id, 2);
        strand.lift = 0.4f + 1.6f * share(id, 3);
        strand.wind = 0.15f + 1.1f * share(id, 4) * share(id, 4);
        strand.wave = 0.45f * share(id, 5);
        strand.phase = 6.3f * share(id, 6);
        hair.curve(flow(strand), 3, 0.00055f, 0.0003f);
    }
}

void add_hair(World& world) {
    Tubes hair;
    add_locks(hair);
    add_flyaways(hair);
    const Paint paint = [](const SurfacePoint& p) { return Matter{hair_colour(p.position), {}}; };
    world.add(std::move(hair), paint);
    world.add(
        sphere(kSkull, kSkullRadii, 48, 32),
        [](const SurfacePoint& p) {
            return Matter{0.6f * hair_colour(p.position), {}};
        },
        Sides::Solid);
}

// A knitted jumper: neck, shoulders and a collar.
void add_person(World& world) {
    const Vec3 skin{0.62f, 0.40f, 0.29f};
    const Paint knit = [](const SurfacePoint& p) {
        const float column = 110 * p.u, row = 60 * p.v;
        const float loop = 0.72f + 0.28f * std::cos(2 * kPi * (column + 0.3f * std::sin(2 * kPi * row)));
        const float band = stripes(9 * p.v + 0.35f, 0.30f, 0.03f);
        return Matter{loop * mix(Vec3{0.70f, 0.64f, 0.52f}, Vec3{0.10f, 0.24f, 0.30f}, band), {}};
    };
    Tubes neck;
    neck.path({kSkull + Vec3{0.004f, -0.05f, 0.01f}, kSkull + Vec3{0.006f, -0.19f, 0.02f}}, 0.046f, 0.052f);
    world.add(std::move(neck), [=](const SurfacePoint&) { return Matter{skin, {}}; });
    world.add(sphere(kSkull + Vec3{0.01f, -0.36f, 0.03f}, {0.215f, 0.185f, 0.12f}, 48, 24), knit,
              Sides::Solid);
}

void build(World& world, float time) {
    world.view.position = {0.06f * time, kEyeHeight, 0};
    world.ambient_above = {1.3f, 1.45f, 1.7f}, world.ambient_below = {0.7f, 0.62f, 0.5f};
    // The sun stands before us, high and to the right: hair in the wind glows along its edge.
    world.lights.push_back({{0.62f, 0.75f, 0.42f}, {4.2f, 3.8f, 3.1f}, 0.02f, true});
    world.lights.push_back({{-1.4f, 2.2f, 0.2f}, {2.2f, 2.1f, 2.0f}, 0.3f});
    add_park(world);
    add_person(world);
    add_hair(world);
    const Foliage beech{{0.14f, 0.09f, 0.05f}, {0.16f, 0.30f, 0.06f}, {0.40f, 0.46f, 0.10f}, 0.042f};
    add_twig(world, {-0.16f, kEyeHeight + 0.13f, 0.52f}, {-0.075f, kEyeHeight + 0.03f, 0.55f}, 8, beech, 5);
    add_twig(world, {-0.15f, kEyeHeight - 0.01f, 0.50f}, {-0.095f, kEyeHeight - 0.08f, 0.52f}, 6, beech, 6);
    add_twig(world, {0.17f, kEyeHeight - 0.10f, 0.60f}, {0.10f, kEyeHeight - 0.07f, 0.58f}, 6, beech, 7);
}

}  // namespace

BuiltInScene hair() {
    return {
        {.name = "hair",
         .purpose = "strands a pixel wide in focus, a bright park behind them, leaves near the lens",
         .camera = {.focal_length_mm = 75, .sensor_width_mm = 36, .f_number = 1.6, .focus_distance_m = 1.43},
         .frames = 48},
        build};
}

}  // namespace petzval::scene
