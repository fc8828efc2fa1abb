#include "scene/gltf/lights.h"

#include <cmath>
#include <cstdio>

namespace petzval::scene {
namespace {

constexpr float kDay = 3;       // irradiance of a sunny day, as scenes have it
constexpr float kNight = 0.1f;  // of the day's sky, where lamps alone shine

}  // namespace

float Lighting::settle(World& world, Vec3 middle, const std::string& path,
                       std::vector<std::string>& warnings) {
    const bool is_night = !lights.empty() && std::none_of(lights.begin(), lights.end(),
                                                          [](const auto& one) { return one.light.distant; });
    const float around = is_night ? kNight : 1;
    day.towards = normalised({-0.5f, 0.9f, -0.6f});
    if (lights.empty()) day.sun = {2.4f, 2.3f, 2.1f};
    day.ambient_above = around * Vec3{0.9f, 0.95f, 1.05f};
    day.ambient_below = around * Vec3{0.35f, 0.33f, 0.3f};
    world.sky = [around](Vec3 d) {
        return around *
               mix(Vec3{0.18f, 0.18f, 0.19f}, Vec3{0.10f, 0.15f, 0.26f}, 0.5f + 0.5f * normalised(d).y);
    };
    float bright = 0;
    for (const PunctualLight& one : lights) bright += luminance(arrival(one.light, middle).facing);
    if (!(bright > kDay)) return 1;
    const float dimmed = kDay / bright;
    for (PunctualLight& one : lights) one.light.power *= dimmed;
    char stops[32];
    std::snprintf(stops, sizeof stops, "%.1f", -double(std::log2(dimmed)));
    warnings.push_back(path + ": its lights are brighter than daylight; lights and emission are dimmed by " +
                       stops + " stops");
    return dimmed;
}

Vec3 Lighting::on(const World& world, const SurfacePoint& at, Vec3 albedo) const {
    Vec3 light = matt(world, day, at, albedo);
    for (const PunctualLight& one : lights)
        light += one.share_at(at.position) / kPi * albedo * irradiance_from(world, one.light, at);
    return light;
}

}  // namespace petzval::scene
