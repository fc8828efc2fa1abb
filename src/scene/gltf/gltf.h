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

// Fills an empty world with the triangles of the file's scene, its base colours and emission.
//
// Light: the file's lights (KHR_lights_punctual) shade them as in shading.h; without lights, a day's light
// does. Lux, candela and nits become scene-linear light without conversion. If the lights make the middle of
// the scene brighter than a day does, everything that glows is dimmed by one factor, which a warning states.
//
// Space: the world is x right, y up, z away; a file's z is turned round. Nodes stand where their animations
// put them at that frame; skins and morph targets stay as they are, with a warning.
//
// Camera: the file's perspective camera of this name or number from 1; of an empty name the first; its sensor
// is 36 mm wide at 16:9. A file without cameras gets one that sees the whole scene. It focuses on the middle
// of the scene.
//
// Missing pictures are left white, with a warning. Errors: InvalidFile with the path, in one line;
// InvalidArgument if the camera does not exist; Unsupported if this petzval was built without tinygltf.
Result<GltfScene> add_gltf(World& world, const std::string& path, int frame, const std::string& camera);

}  // namespace petzval::scene
