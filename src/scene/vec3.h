// Three floats: a point, a direction or a linear Rec.709 colour. World axes: +x right, +y up, +z away from
// the viewer, in metres.
#pragma once

#include <algorithm>
#include <cmath>

namespace petzval::scene {

struct Vec3 {
    float x = 0, y = 0, z = 0;

    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
    friend Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Vec3 operator*(float s, Vec3 a) { return a * s; }
    friend Vec3 operator/(Vec3 a, float s) { return a * (1 / s); }
    Vec3& operator+=(Vec3 b) { return *this = *this + b; }
    Vec3& operator*=(float s) { return *this = *this * s; }
};

inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
// A place in metres that rays can be traced from and to; false for NaN.
inline bool is_somewhere(Vec3 place) { return dot(place, place) <= 1e24f; }
inline Vec3 normalised(Vec3 a) { return a / std::max(length(a), 1e-20f); }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline Vec3 mix(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }
inline float luminance(Vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

constexpr float kPi = 3.14159265358979f;

}  // namespace petzval::scene
