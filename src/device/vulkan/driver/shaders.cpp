#include "device/vulkan/driver/shaders.h"

#include <array>
#include <cstddef>

namespace petzval::device::vulkan {
namespace {

constexpr std::uint32_t kComposite[] =
#include "composite.comp.inc"
    ;
constexpr std::uint32_t kAddSectors[] =
#include "add_sectors.comp.inc"
    ;
constexpr std::uint32_t kFindCasters[] =
#include "find_casters.comp.inc"
    ;
constexpr std::uint32_t kCoverPupil[] =
#include "cover_pupil.comp.inc"
    ;
constexpr std::uint32_t kOpenPupil[] =
#include "open_pupil.comp.inc"
    ;
constexpr std::uint32_t kAddLights[] =
#include "add_lights.comp.inc"
    ;
constexpr std::uint32_t kAddCells[] =
#include "add_cells.comp.inc"
    ;
constexpr std::uint32_t kGather[] =
#include "gather.comp.inc"
    ;
constexpr std::uint32_t kSpreadColumns[] =
#include "spread_columns.comp.inc"
    ;
constexpr std::uint32_t kSpreadCells[] =
#include "spread_cells.comp.inc"
    ;
constexpr std::uint32_t kBlurCells[] =
#include "blur_cells.comp.inc"
    ;
constexpr std::uint32_t kMixBlurs[] =
#include "mix_blurs.comp.inc"
    ;
constexpr std::uint32_t kPlaceTiles[] =
#include "place_tiles.comp.inc"
    ;
constexpr std::uint32_t kGlareLight[] =
#include "glare_light.comp.inc"
    ;
constexpr std::uint32_t kGlareHalve[] =
#include "glare_halve.comp.inc"
    ;
constexpr std::uint32_t kGlareBlur[] =
#include "glare_blur.comp.inc"
    ;
constexpr std::uint32_t kGlareEnlarge[] =
#include "glare_enlarge.comp.inc"
    ;
constexpr std::uint32_t kGlareSum[] =
#include "glare_sum.comp.inc"
    ;
constexpr std::uint32_t kGlareAdd[] =
#include "glare_add.comp.inc"
    ;
constexpr std::uint32_t kStarReduce[] =
#include "star_reduce.comp.inc"
    ;
constexpr std::uint32_t kStarStreak[] =
#include "star_streak.comp.inc"
    ;
constexpr std::uint32_t kStarEnlarge[] =
#include "star_enlarge.comp.inc"
    ;
constexpr std::uint32_t kStarLoad[] =
#include "star_load.comp.inc"
    ;
constexpr std::uint32_t kStarTransform[] =
#include "star_transform.comp.inc"
    ;
constexpr std::uint32_t kStarFilter[] =
#include "star_filter.comp.inc"
    ;
constexpr std::uint32_t kStarAdd[] =
#include "star_add.comp.inc"
    ;
constexpr std::uint32_t kDevelop[] =
#include "develop.comp.inc"
    ;
constexpr std::uint32_t kRealtimeMeasure[] =
#include "realtime_measure.comp.inc"
    ;
constexpr std::uint32_t kRealtimeSplit[] =
#include "realtime_split.comp.inc"
    ;
constexpr std::uint32_t kRealtimeReach[] =
#include "realtime_reach.comp.inc"
    ;
constexpr std::uint32_t kRealtimeGather[] =
#include "realtime_gather.comp.inc"
    ;
constexpr std::uint32_t kRealtimeCombine16[] =
#include "realtime_combine_16.comp.inc"
    ;
constexpr std::uint32_t kRealtimeCombine32[] =
#include "realtime_combine_32.comp.inc"
    ;
constexpr std::uint32_t kRealtimeCombine11[] =
#include "realtime_combine_11.comp.inc"
    ;

constexpr VkDescriptorType kSampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           kStored = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                           kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array kBuffers{kBuffer, kBuffer, kBuffer, kBuffer, kBuffer, kBuffer, kBuffer, kBuffer};
constexpr std::array kOfMeasure{kSampled, kBuffer};
constexpr std::array kOfSplit{kSampled, kSampled, kStored, kStored, kStored,
                              kStored,  kBuffer,  kBuffer, kBuffer, kBuffer};
constexpr std::array kOfReach{kBuffer, kBuffer, kBuffer, kBuffer, kBuffer, kBuffer};
constexpr std::array kOfGather{kSampled, kBuffer, kBuffer, kStored};
constexpr std::array kOfCombine{kSampled, kSampled, kSampled, kSampled, kStored,
                                kBuffer,  kBuffer,  kBuffer,  kBuffer,  kBuffer};

std::span<const VkDescriptorType> buffers(std::size_t count) { return std::span(kBuffers).first(count); }

}  // namespace

ShaderWords words_of(Shader shader) {
    // In the order of Shader.
    static const std::array kWords{
        ShaderWords{kComposite, buffers(7), 52},         ShaderWords{kAddSectors, buffers(4), 4},
        ShaderWords{kFindCasters, buffers(3), 28},       ShaderWords{kCoverPupil, buffers(3), 8},
        ShaderWords{kOpenPupil, buffers(3), 4},          ShaderWords{kAddLights, buffers(6), 36},
        ShaderWords{kAddCells, buffers(3), 8},           ShaderWords{kGather, buffers(4), 36},
        ShaderWords{kSpreadColumns, buffers(7), 72},     ShaderWords{kSpreadCells, buffers(5), 72},
        ShaderWords{kBlurCells, buffers(5), 72},         ShaderWords{kMixBlurs, buffers(8), 72},
        ShaderWords{kPlaceTiles, buffers(3), 12},        ShaderWords{kGlareLight, buffers(2), 20},
        ShaderWords{kGlareHalve, buffers(2), 8},         ShaderWords{kGlareBlur, buffers(3), 28},
        ShaderWords{kGlareEnlarge, buffers(2), 12},      ShaderWords{kGlareSum, buffers(2), 4},
        ShaderWords{kGlareAdd, buffers(5), 48},          ShaderWords{kStarReduce, buffers(2), 24},
        ShaderWords{kStarStreak, buffers(3), 24},        ShaderWords{kStarEnlarge, buffers(2), 24},
        ShaderWords{kStarLoad, buffers(2), 52},          ShaderWords{kStarTransform, buffers(3), 52},
        ShaderWords{kStarFilter, buffers(4), 52},        ShaderWords{kStarAdd, buffers(2), 52},
        ShaderWords{kDevelop, buffers(2), 52},           ShaderWords{kRealtimeMeasure, kOfMeasure, 60},
        ShaderWords{kRealtimeSplit, kOfSplit, 60},       ShaderWords{kRealtimeReach, kOfReach, 60},
        ShaderWords{kRealtimeGather, kOfGather, 60},     ShaderWords{kRealtimeCombine16, kOfCombine, 60},
        ShaderWords{kRealtimeCombine32, kOfCombine, 60}, ShaderWords{kRealtimeCombine11, kOfCombine, 60},
    };
    return kWords[std::size_t(shader)];
}

}  // namespace petzval::device::vulkan
