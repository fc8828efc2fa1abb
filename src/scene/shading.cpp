#include "scene/shading.h"

#include <algorithm>
#include <cmath>

namespace petzval::scene {
namespace {

Vec3 facing_eye(const SurfacePoint& at) {
    const Vec3 normal = normalised(at.normal);
    return dot(normal, at.direction) > 0 ? -normal : normal;
}

Vec3 schlick(Vec3 facing, float cosine) {
    return facing + (Vec3{1, 1, 1} - facing) * std::pow(1 - std::clamp(cosine, 0.0f, 1.0f), 5.0f);
}

}  // namespace

Vec3 matt(const World& world, const Daylight& light, const SurfacePoint& at, Vec3 albedo) {
    const Vec3 normal = facing_eye(at);
    Vec3 irradiance = mix(light.ambient_below, light.ambient_above, 0.5f + 0.5f * normal.y);
    const float cosine = dot(normal, light.towards);
    if (cosine > 0 && !world.is_shaded(at.position + 1e-3f * normal, light.towards, true))
        irradiance += cosine * light.sun;
    return albedo * irradiance / kPi;
}

Vec3 irradiance_from(const World& world, const Light& light, const SurfacePoint& at) {
    const Vec3 normal = facing_eye(at), from = at.position + 1e-3f * normal;
    const Arrival a = arrival(light, from);
    const float cosine = dot(normal, normalised(a.towards));
    if (cosine <= 0 || world.is_shaded(from, a.towards, light.distant)) return {};
    return cosine * a.facing;
}

Vec3 gloss(const World& world, const SurfacePoint& at, float exponent) {
    constexpr float kFaintest = 1e-6f;
    const float most = (exponent + 8) / (8 * kPi);
    // Most lamps lie far off the highlight: they are left before the power is taken, at a hair less than the
    // cosine below which it is too faint.
    const float least_half = 0.999f * std::pow(kFaintest / most, 1 / exponent);
    const Vec3 normal = facing_eye(at);
    Vec3 sum;
    for (const Lamp& lamp : world.lamps()) {
        const Vec3 towards = lamp.centre - at.position;
        if (dot(normal, towards) <= 0) continue;
        const float distance2 = std::max(dot(towards, towards), 1e-4f);
        const Vec3 to_lamp = towards / std::sqrt(distance2), middle = to_lamp - at.direction;
        const float off = dot(normal, middle);
        if (off <= 0 || off * off < least_half * least_half * dot(middle, middle)) continue;
        const float cosine = dot(normal, to_lamp), half = dot(normal, normalised(middle));
        const float lobe = most * std::pow(half, exponent) * cosine;
        if (lobe < kFaintest) continue;
        sum += lobe * (kPi * lamp.radius_m * lamp.radius_m / distance2) * lamp.radiance;
    }
    return sum;
}

Vec3 mirrored(const World& world, const SurfacePoint& at, Vec3 facing) {
    if (at.in_mirror) return {};
    const Vec3 normal = facing_eye(at);
    const float cosine = -dot(normal, at.direction);
    const Vec3 direction = at.direction + 2 * cosine * normal;
    return schlick(facing, cosine) * world.seen(at.position + 1e-3f * normal, direction);
}

}  // namespace petzval::scene
