// Scenes in glTF 2.0 files (Khronos), through tinygltf where it was found.
#pragma once

#include "petzval/camera.h"
#include "petzval/result.h"

#include "scene/world.h"

#include <string>
#include <vector>

namespace petzval::scene {

// Whether a scene of that name is a file of this kind.
bool is_gltf(const std::string& name);

// Fills an empty world with the triangles of the file's scene, its base colours and emission, shaded as
// shading.h has it by the file's lights (KHR_lights_punctual), or where it has none by a day's. Lux, candela
// and nits are taken for light as it is; where the lights make the middle of the scene brighter than a day
// does, all that glows is dimmed alike, with a warning that says how far. The world is x right, y up, z away:
// a file's z turned round. Animations are not played. The camera is the file's first with a perspective, of a
// sensor 36 mm wide at 16:9, else one that sees all of it; it focuses on the middle of what is there.
// Pictures that are missing are left white, with a warning. Errors: InvalidFile with the path, in one line;
// Unsupported where this petzval has no tinygltf.
Status add_gltf(World& world, const std::string& path, Camera& camera, std::vector<std::string>& warnings);

}  // namespace petzval::scene
