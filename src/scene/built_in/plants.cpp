#include "scene/built_in/plants.h"

#include "scene/textures.h"

namespace petzval::scene {

Mesh leaf(Vec3 stalk, Vec3 tip, Vec3 facing, float half_width, int pieces) {
    const Vec3 along = tip - stalk, across = normalised(cross(along, facing));
    const Vec3 out = normalised(cross(across, along));
    Mesh mesh;
    for (int j = 0; j <= pieces; ++j) {
        const float t = float(j) / float(pieces), width = half_width * std::sin(kPi * std::pow(t, 0.8f));
        for (int i = -1; i <= 1; ++i) {
            const float bend = 0.18f * length(along) * t * t - 0.3f * width * float(i * i);
            mesh.positions.push_back(stalk + t * along + float(i) * width * across - bend * out);
            mesh.normals.push_back(normalised(out + 0.3f * float(i) * across));
            mesh.uv.push_back({0.5f * float(i + 1), t});
        }
    }
    for (std::uint32_t j = 0; j < std::uint32_t(pieces); ++j)
        for (std::uint32_t i = 0; i < 2; ++i) {
            const std::uint32_t a = 3 * j + i;
            mesh.triangles.push_back({a, a + 1, a + 3});
            mesh.triangles.push_back({a + 1, a + 4, a + 3});
        }
    return mesh;
}

Mesh bush(Vec3 centre, Vec3 radii, float rough) {
    Mesh mesh = sphere(centre, radii, 24, 14);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3 from = mesh.positions[i] - centre;
        const Vec3 on_sphere{from.x / radii.x, from.y / radii.y, from.z / radii.z};
        const float bulge = fractal_noise(3.1f * on_sphere + 1.7f * centre, 3);
        mesh.positions[i] = centre + from * (1 + rough * bulge);
    }
    return mesh;
}

void add_twig(World& world, Vec3 from, Vec3 to, int leaves, const Foliage& foliage, std::uint32_t seed) {
    const auto on_branch = [&](float t) {
        const Vec3 sway{0.01f * std::sin(9 * t), 0.06f * t * (1 - t), 0.012f * std::sin(7 * t)};
        return mix(from, to, t) + sway;
    };
    Tubes wood;
    std::vector<Vec3> through;
    for (int i = 0; i <= 12; ++i) through.push_back(on_branch(float(i) / 12));
    wood.path(through, 0.0042f, 0.0016f);

    const Vec3 along = normalised(to - from);
    Mesh green;
    for (int i = 0; i < leaves; ++i) {
        const auto random = [&](int what) { return cell_value(i, what, seed); };
        const Vec3 stalk = on_branch(0.15f + 0.85f * float(i) / float(leaves));
        const float turn = (i % 2 ? 1.0f : -1.0f) * (0.5f + 0.8f * random(0));
        const float size = foliage.leaf_length_m * (0.75f + 0.5f * random(1));
        const Vec3 aside = normalised(Vec3{-along.y, along.x, 0.4f * (random(2) - 0.5f)});
        const Vec3 direction = normalised(along + turn * aside + Vec3{0, -0.35f, 0});
        const Vec3 facing = normalised(Vec3{random(3) - 0.5f, 0.5f, -0.8f});
        wood.line(stalk, stalk + 0.2f * size * direction, 0.0011f);
        green.append(
            leaf(stalk + 0.2f * size * direction, stalk + 1.2f * size * direction, facing, 0.3f * size));
    }
    world.add(std::move(wood), [=](const SurfacePoint&) { return Matter{foliage.stem, {}}; });
    world.add(
        std::move(green),
        [=](const SurfacePoint& p) {
            const float vein = 1 - 0.35f * smoothstep(0.06f, 0.02f, std::abs(p.u - 0.5f));
            return Matter{vein * mix(foliage.leaf_at_stalk, foliage.leaf_at_tip, p.v), {}};
        },
        Sides::Leaf);
}

}  // namespace petzval::scene
