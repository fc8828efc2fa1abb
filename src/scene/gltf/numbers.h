// Numbers of a glTF file: the bytes of an accessor, checked to be there.
#pragma once

#include "petzval/result.h"

#include <cstddef>
#include <string>
#include <tiny_gltf.h>

namespace petzval::scene {

struct GltfNumbers {
    const unsigned char* first = nullptr;  // of the model's buffers
    std::size_t stride = 0, count = 0;
    int type = 0;  // of a component
    bool normalised = false;

    double at(std::size_t i, std::size_t component) const;
};

// kind: TINYGLTF_TYPE_SCALAR, …. Errors: InvalidFile with the path.
Result<GltfNumbers> gltf_numbers(const tinygltf::Model& model, int accessor, int kind,
                                 const std::string& path);

}  // namespace petzval::scene
