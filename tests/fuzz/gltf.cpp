// Scenes as glTF, text and binary.
#include "scene/gltf/gltf.h"

#include "fuzz/held_file.h"
#include "scene/world.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const bool is_binary = size > 4 && bytes[0] == 'g' && bytes[1] == 'l';
    const std::string path = petzval::fuzz::held_file(bytes, size, is_binary ? ".glb" : ".gltf");
    petzval::scene::World world;
    const auto scene = petzval::scene::add_gltf(world, path, 1, "");
    if (!scene) petzval::fuzz::check_message(scene.error().message);
    return 0;
}
