#include "scene/shapes.h"

namespace petzval::scene {

void Mesh::append(const Mesh& other) {
    const std::uint32_t base = std::uint32_t(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
    uv.insert(uv.end(), other.uv.begin(), other.uv.end());
    for (const auto& t : other.triangles) triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

void Mesh::place(float yaw_rad, Vec3 to) {
    const float c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    const auto turned = [&](Vec3 p) { return Vec3{c * p.x + s * p.z, p.y, -s * p.x + c * p.z}; };
    for (Vec3& p : positions) p = turned(p) + to;
    for (Vec3& n : normals) n = turned(n);
}

namespace {

// Triangles of a grid of (nu + 1) x (nv + 1) vertices, row by row.
void connect_grid(Mesh& mesh, int nu, int nv) {
    const std::uint32_t row = std::uint32_t(nu) + 1;
    for (std::uint32_t j = 0; j < std::uint32_t(nv); ++j)
        for (std::uint32_t i = 0; i < std::uint32_t(nu); ++i) {
            const std::uint32_t a = j * row + i;
            mesh.triangles.push_back({a, a + 1, a + row});
            mesh.triangles.push_back({a + 1, a + row + 1, a + row});
        }
}

}  // namespace

Mesh patch(Vec3 corner, Vec3 edge_u, Vec3 edge_v, int nu, int nv) {
    Mesh mesh;
    const Vec3 normal = normalised(cross(edge_v, edge_u));
    for (int j = 0; j <= nv; ++j)
        for (int i = 0; i <= nu; ++i) {
            const float u = float(i) / float(nu), v = float(j) / float(nv);
            mesh.positions.push_back(corner + u * edge_u + v * edge_v);
            mesh.normals.push_back(normal);
            mesh.uv.push_back({u, v});
        }
    connect_grid(mesh, nu, nv);
    return mesh;
}

Mesh box(Vec3 centre, Vec3 h, int cells) {
    Mesh mesh;
    const auto face = [&](Vec3 u, Vec3 v) {
        const Vec3 out = normalised(cross(v, u));
        const Vec3 middle = centre + out * h;
        Mesh side = patch(middle - u - v, 2 * u, 2 * v, cells, cells);
        for (auto& t : side.uv) t = {t[0] * 2 * length(u), t[1] * 2 * length(v)};
        mesh.append(side);
    };
    face({h.x, 0, 0}, {0, h.y, 0});   // towards -z, the viewer
    face({-h.x, 0, 0}, {0, h.y, 0});  // away
    face({0, 0, -h.z}, {0, h.y, 0});  // left
    face({0, 0, h.z}, {0, h.y, 0});   // right
    face({h.x, 0, 0}, {0, 0, h.z});   // top
    face({h.x, 0, 0}, {0, 0, -h.z});  // bottom
    return mesh;
}

Mesh sphere(Vec3 centre, Vec3 radii, int around, int up) {
    Mesh mesh;
    for (int j = 0; j <= up; ++j)
        for (int i = 0; i <= around; ++i) {
            const float u = float(i) / float(around), v = float(j) / float(up);
            const float azimuth = 2 * kPi * u, polar = kPi * v;
            const Vec3 n{std::sin(polar) * std::sin(azimuth), -std::cos(polar),
                         -std::sin(polar) * std::cos(azimuth)};
            mesh.positions.push_back(centre + n * radii);
            mesh.normals.push_back(normalised({n.x / radii.x, n.y / radii.y, n.z / radii.z}));
            mesh.uv.push_back({u, v});
        }
    connect_grid(mesh, around, up);
    return mesh;
}

Mesh torus(Vec3 centre, Vec3 axis, float ring_radius, float tube_radius, int along, int around) {
    Mesh mesh;
    const Vec3 across = normalised(cross(axis, {0.31f, 0.87f, 0.38f})), other = cross(axis, across);
    for (int j = 0; j <= around; ++j)
        for (int i = 0; i <= along; ++i) {
            const float u = float(i) / float(along), v = float(j) / float(around);
            const Vec3 out = std::cos(2 * kPi * u) * across + std::sin(2 * kPi * u) * other;
            const Vec3 normal = std::cos(2 * kPi * v) * out + std::sin(2 * kPi * v) * axis;
            mesh.positions.push_back(centre + ring_radius * out + tube_radius * normal);
            mesh.normals.push_back(normal);
            mesh.uv.push_back({u, v});
        }
    connect_grid(mesh, along, around);
    return mesh;
}

Mesh lathe(Vec3 base, const std::vector<std::array<float, 2>>& outline, int around) {
    Mesh mesh;
    const int up = int(outline.size()) - 1;
    for (int j = 0; j <= up; ++j) {
        const auto& before = outline[std::size_t(std::max(0, j - 1))];
        const auto& after = outline[std::size_t(std::min(up, j + 1))];
        const float outwards = after[1] - before[1], upwards = before[0] - after[0];
        const auto [radius, height] = outline[std::size_t(j)];
        for (int i = 0; i <= around; ++i) {
            const float u = float(i) / float(around), azimuth = 2 * kPi * u;
            const Vec3 side{std::sin(azimuth), 0, -std::cos(azimuth)};
            mesh.positions.push_back(base + radius * side + Vec3{0, height, 0});
            mesh.normals.push_back(normalised(outwards * side + Vec3{0, upwards, 0}));
            mesh.uv.push_back({u, float(j) / float(up)});
        }
    }
    connect_grid(mesh, around, up);
    return mesh;
}

void Tubes::path(const std::vector<Vec3>& through, float first_radius, float last_radius) {
    for (std::size_t i = 0; i < through.size(); ++i) {
        if (i + 1 < through.size()) segments.push_back(std::uint32_t(points.size()));
        const float t = float(i) / float(through.size() - 1);
        points.push_back({through[i], mix(first_radius, last_radius, t)});
    }
}

void Tubes::curve(const std::vector<Vec3>& through, int pieces, float first_radius, float last_radius) {
    std::vector<Vec3> fine;
    const auto point = [&](std::size_t i, int step) {
        const std::size_t last = through.size() - 1;
        return through[step < 0 ? (i == 0 ? 0 : i - 1) : std::min(i + std::size_t(step), last)];
    };
    for (std::size_t i = 0; i + 1 < through.size(); ++i)
        for (int k = 0; k < pieces; ++k) {
            const float t = float(k) / float(pieces);
            const Vec3 a = point(i, -1), b = point(i, 0), c = point(i, 1), d = point(i, 2);
            fine.push_back(0.5f * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) +
                                   t * t * t * (3 * b - a - 3 * c + d)));
        }
    fine.push_back(through.back());
    path(fine, first_radius, last_radius);
}

void Tubes::arc(Vec3 centre, Vec3 a, Vec3 b, float circle, float from, float to, int pieces, float radius) {
    std::vector<Vec3> through;
    for (int i = 0; i <= pieces; ++i) {
        const float angle = mix(from, to, float(i) / float(pieces));
        through.push_back(centre + circle * (std::cos(angle) * a + std::sin(angle) * b));
    }
    path(through, radius, radius);
}

}  // namespace petzval::scene
