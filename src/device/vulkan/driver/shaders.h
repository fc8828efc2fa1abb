// The programs of the device, compiled into the library.
#pragma once

#include "device/vulkan/driver/functions.h"

#include <cstdint>
#include <span>

namespace petzval::device::vulkan {

enum class Shader {
    Composite,
    AddSectors,
    FindCasters,
    CoverPupil,
    OpenPupil,
    AddLights,
    AddCells,
    Gather,
    SpreadColumns,
    SpreadCells,
    BlurCells,
    MixBlurs,
    PlaceTiles,
    GlareLight,
    GlareHalve,
    GlareBlur,
    GlareEnlarge,
    GlareSum,
    GlareAdd,
    StarReduce,
    StarStreak,
    StarEnlarge,
    StarLoad,
    StarTransform,
    StarFilter,
    StarAdd,
    Develop,
    RealtimeMeasure,
    RealtimeSplit,
    RealtimeReach,
    RealtimeGather,
    RealtimeCombine16,  // its result is rgba16f
    RealtimeCombine32,  // rgba32f
    RealtimeCombine11   // r11f_g11f_b10f
};

struct ShaderWords {
    std::span<const std::uint32_t> spirv;
    std::span<const VkDescriptorType> bindings;  // from 0 on
    std::uint32_t push_bytes;                    // of push constants
};

ShaderWords words_of(Shader shader);

}  // namespace petzval::device::vulkan
