// Scenes in glTF 2.0 files (Khronos), through tinygltf where it was found.
#pragma once

#include "petzval/camera.h"
#include "petzval/result.h"

#include "scene/world.h"

#include <string>
#include <vector>

namespace petzval::scene {

// True if a scene of that name is a glTF file.
bool is_gltf(const std::string& name);

constexpr double kGltfFramesPerSecond = 24;

struct GltfScene {
    Camera camera;
    int frames = 1;  // > 1: its nodes move
    std::vector<std::string> cameras, warnings;
};

// Fills an empty world with the triangles of the file's scene, its base colours and emission, shaded as
// shading.h has it by the file's lights (KHR_lights_punctual), or where it has none by a day's. Lux, candela
// and nits are taken for light as it is; where the lights make the middle of the scene brighter than a day
// does, all that glows is dimmed alike, with a warning that says how far. The world is x right, y up, z away:
// a file's z turned round. Its nodes stand where its animations have them at that frame; skins and morph
// targets stay as they are, with a warning. The camera is that of this name, or number from 1, of the file's
// with a perspective, of an empty name the first, of a sensor 36 mm wide at 16:9; where it has none, one that
// sees all of it. It focuses on the middle of what is there. Pictures that are missing are left white, with a
// warning. Errors: InvalidFile with the path, in one line; InvalidArgument where there is no such camera;
// Unsupported where this petzval has no tinygltf.
Result<GltfScene> add_gltf(World& world, const std::string& path, int frame, const std::string& camera);

}  // namespace petzval::scene
