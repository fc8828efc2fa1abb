// Sets of given lights, one file each; point_sets.cpp lists them.
//
// The pinhole stands in the origin, its axis along +z; y is up. A point of the scene lies in the picture at
// (centre_x + focal_px x/z, horizon_px - focal_px y/z).
#pragma once

#include "petzval/scene.h"

#include "scene/dice.h"
#include "scene/sampling.h"
#include "scene/vec3.h"

#include <cstdint>
#include <vector>

namespace petzval::scene {

inline constexpr double kUsualHorizon = 0.5;

struct PointView {
    explicit PointView(const PointSettings& settings)
        : width(settings.width),
          height(settings.height),
          focal_px(float(settings.focal_length_mm / settings.sensor_width_mm * settings.width)),
          centre_x(0.5f * float(settings.width)),
          horizon_px(float(settings.horizon.value_or(kUsualHorizon) * settings.height)) {}
    int width, height;
    float focal_px, centre_x, horizon_px;

    bool shows(Vec3 p) const {
        const LightPoint at = light(p, {});
        return at.x >= 0 && at.y >= 0 && at.x < float(width) && at.y < float(height);
    }
    // Light point of this intensity (1: one unit in a picture of 1000 px focal length, from 1 m).
    LightPoint light(Vec3 p, Vec3 intensity) const {
        const float per_pixel = focal_px * 1e-3f / p.z;
        const Vec3 light = per_pixel * per_pixel * intensity;
        LightPoint point;
        point.x = centre_x + focal_px * p.x / p.z, point.y = horizon_px - focal_px * p.y / p.z;
        point.r = light.x, point.g = light.y, point.b = light.z;
        point.depth_m = p.z;
        return point;
    }
};

struct PointSet {
    PointSetSummary summary;
    // `count` lights, or all there are if these are fewer.
    std::vector<LightPoint> (*make)(const PointView& view, int count, std::uint64_t seed) = nullptr;
};

PointSet glints();
PointSet city();
PointSet drops();

}  // namespace petzval::scene
