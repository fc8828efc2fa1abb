// The programs of the device, compiled into the library.
#pragma once

#include <cstdint>
#include <span>

namespace petzval::device::vulkan {

enum class Shader {
    Composite,
    AddSectors,
    CoverPupil,
    OpenPupil,
    AddLights,
    AddCells,
    Gather,
    SpreadCells,
    BlurCells,
    MixBlurs
};

struct ShaderWords {
    std::span<const std::uint32_t> spirv;
    int buffers;               // storage buffers, bound from 0 on
    std::uint32_t push_bytes;  // of push constants
};

ShaderWords words_of(Shader shader);

}  // namespace petzval::device::vulkan
