#include "device/vulkan/shaders.h"

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
constexpr std::uint32_t kSpreadCells[] =
#include "spread_cells.comp.inc"
    ;
constexpr std::uint32_t kBlurCells[] =
#include "blur_cells.comp.inc"
    ;
constexpr std::uint32_t kMixBlurs[] =
#include "mix_blurs.comp.inc"
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

constexpr VkDescriptorType kSampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                           kStored = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
                           kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array kBuffers{kBuffer, kBuffer, kBuffer, kBuffer, kBuffer, kBuffer, kBuffer};
constexpr std::array kOfMeasure{kSampled, kBuffer};
constexpr std::array kOfSplit{kSampled, kSampled, kStored, kStored, kStored,
                              kStored,  kBuffer,  kBuffer, kBuffer};
constexpr std::array kOfGather{kSampled, kBuffer, kBuffer, kStored};
constexpr std::array kOfCombine{kSampled, kSampled, kSampled, kSampled, kStored,
                                kBuffer,  kBuffer,  kBuffer,  kBuffer};

std::span<const VkDescriptorType> buffers(std::size_t count) { return std::span(kBuffers).first(count); }

}  // namespace

ShaderWords words_of(Shader shader) {
    switch (shader) {
        case Shader::Composite:
            return {kComposite, buffers(7), 48};
        case Shader::AddSectors:
            return {kAddSectors, buffers(4), 4};
        case Shader::CoverPupil:
            return {kCoverPupil, buffers(3), 8};
        case Shader::OpenPupil:
            return {kOpenPupil, buffers(3), 4};
        case Shader::AddLights:
            return {kAddLights, buffers(6), 36};
        case Shader::AddCells:
            return {kAddCells, buffers(3), 8};
        case Shader::Gather:
            return {kGather, buffers(4), 36};
        case Shader::SpreadCells:
            return {kSpreadCells, buffers(5), 84};
        case Shader::BlurCells:
            return {kBlurCells, buffers(5), 84};
        case Shader::MixBlurs:
            return {kMixBlurs, buffers(6), 84};
        case Shader::RealtimeMeasure:
            return {kRealtimeMeasure, kOfMeasure, 36};
        case Shader::RealtimeSplit:
            return {kRealtimeSplit, kOfSplit, 36};
        case Shader::RealtimeReach:
            return {kRealtimeReach, buffers(4), 36};
        case Shader::RealtimeGather:
            return {kRealtimeGather, kOfGather, 36};
        case Shader::RealtimeCombine16:
            return {kRealtimeCombine16, kOfCombine, 36};
        case Shader::RealtimeCombine32:
            break;
    }
    return {kRealtimeCombine32, kOfCombine, 36};
}

}  // namespace petzval::device::vulkan
