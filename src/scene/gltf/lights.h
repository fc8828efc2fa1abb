// Lights of a glTF scene: its own, or daylight.
#pragma once

#include "scene/shading.h"

#include <algorithm>
#include <string>
#include <vector>

namespace petzval::scene {

// A light of KHR_lights_punctual: without size; a spot's fades from its inner to its outer cone.
struct PunctualLight {
    Light light;
    Vec3 axis;                             // along which a spot shines
    float cos_inner = -1, cos_outer = -2;  // of the cones' half angles; everywhere: no spot

    // Share of light towards a place, as the extension defines it.
    float share_at(Vec3 place) const {
        if (cos_outer < -1) return 1;
        const float cosine = dot(axis, normalised(place - light.position));
        const float share = (cosine - cos_outer) / std::max(cos_inner - cos_outer, 0.001f);
        return std::clamp(share, 0.0f, 1.0f) * std::clamp(share, 0.0f, 1.0f);
    }
};

struct Lighting {
    Daylight day;
    std::vector<PunctualLight> lights;

    // Called once all lights are known: sets daylight and sky relative to them, by the brightness in the
    // scene's middle. Returns the factor for glowing surfaces, with a warning if it is not 1.
    float settle(World& world, Vec3 middle, const std::string& path, std::vector<std::string>& warnings);
    // Light reflected by a matt surface. Requires: as matt().
    Vec3 on(const World& world, const SurfacePoint& at, Vec3 albedo) const;
};

}  // namespace petzval::scene
