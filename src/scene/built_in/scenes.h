// The built-in scenes, one file each; scene_list.cpp lists them.
#pragma once

#include "petzval/scene.h"
#include "petzval/workers.h"

#include "scene/world.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace petzval::scene {

struct BuiltInScene {
    SceneSummary summary;
    // Fills an empty world as it stands at `time`, 0 at the first frame and 1 at the last.
    std::function<void(World& world, float time)> build = nullptr;
    // Position of the scene's subject at a time; null: no particular subject.
    Vec3 (*subject)(float time) = nullptr;
};

BuiltInScene night();
BuiltInScene fence();
BuiltInScene table();
BuiltInScene slant();
BuiltInScene bars();
BuiltInScene dynamic_range();
BuiltInScene lanterns();
BuiltInScene hair();
BuiltInScene post();
BuiltInScene meadow();
BuiltInScene tori();
BuiltInScene cubes();
BuiltInScene rows();
BuiltInScene cutouts();
// Scenes of three articles, shaded like their shaders: built within milliseconds, for a window.
BuiltInScene hexadrive();
BuiltInScene wgld();
BuiltInScene unity();
// Another one for every seed: made_up.h.
BuiltInScene random_scene(std::uint64_t seed);

// The same things a frame before and after, not committed; null: no motion is wanted.
struct WorldsAround {
    std::unique_ptr<World> before, after;
};
// The passes over a world that was committed.
Result<RenderedScene> render(const World& world, const WorldsAround& around, const Camera& camera,
                             const SceneSettings& settings, Workers& workers);

}  // namespace petzval::scene
