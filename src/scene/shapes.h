// Builders of the geometry that scenes are made of: triangle meshes and round tubes.
#pragma once

#include "scene/vec3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace petzval::scene {

struct Mesh {
    std::vector<Vec3> positions, normals;  // per vertex; normals point outwards
    std::vector<std::array<float, 2>> uv;  // texture coordinates per vertex
    std::vector<std::array<std::uint32_t, 3>> triangles;

    void append(const Mesh& other);
    // Turns by `yaw_rad` about the vertical axis through the origin (from +z towards +x), then moves.
    void place(float yaw_rad, Vec3 to);
};

// A parallelogram of nu x nv cells; its normal is along cross(edge_v, edge_u); uv runs 0…1 along the edges.
Mesh patch(Vec3 corner, Vec3 edge_u, Vec3 edge_v, int nu, int nv);
// Axis-aligned box; every face has uv in metres and `cells` cells along each side.
Mesh box(Vec3 centre, Vec3 half_size, int cells);
// u runs around, v from the bottom pole to the top.
Mesh sphere(Vec3 centre, Vec3 radii, int around, int up);

// A ring around `centre`, its hole seen along the unit vector `axis`. u runs along the ring, v around it.
Mesh torus(Vec3 centre, Vec3 axis, float ring_radius, float tube_radius, int along, int around);

// A turned body standing at `base`; its outline is radius and height from the bottom upwards. u runs around,
// v up.
Mesh lathe(Vec3 base, const std::vector<std::array<float, 2>>& outline, int around);

// Round tubes: every pair of consecutive points of a path is a segment with round ends.
struct Tubes {
    struct Point {
        Vec3 position;
        float radius = 0;
    };
    std::vector<Point> points;
    std::vector<std::uint32_t> segments;  // index of the first point of each

    void line(Vec3 a, Vec3 b, float radius) { path({a, b}, radius, radius); }
    // The radius runs from first to last along the path.
    void path(const std::vector<Vec3>& through, float first_radius, float last_radius);
    // A smooth curve through the points (Catmull-Rom), `pieces` segments between two of them.
    void curve(const std::vector<Vec3>& through, int pieces, float first_radius, float last_radius);
    // An arc of `circle` radius in the plane of unit vectors a and b, from angle to angle (radians, a towards
    // b).
    void arc(Vec3 centre, Vec3 a, Vec3 b, float circle, float from, float to, int pieces, float radius);
};

}  // namespace petzval::scene
