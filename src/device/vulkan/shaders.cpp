#include "device/vulkan/shaders.h"

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

}  // namespace

ShaderWords words_of(Shader shader) {
    switch (shader) {
        case Shader::Composite:
            return {kComposite, 7, 48};
        case Shader::AddSectors:
            return {kAddSectors, 4, 4};
        case Shader::CoverPupil:
            return {kCoverPupil, 3, 8};
        case Shader::OpenPupil:
            return {kOpenPupil, 3, 4};
        case Shader::AddLights:
            return {kAddLights, 6, 36};
        case Shader::AddCells:
            return {kAddCells, 3, 8};
        case Shader::Gather:
            return {kGather, 4, 36};
        case Shader::SpreadCells:
            return {kSpreadCells, 5, 84};
        case Shader::BlurCells:
            return {kBlurCells, 5, 84};
        case Shader::MixBlurs:
            return {kMixBlurs, 6, 84};
        case Shader::RealtimeMeasure:
            return {kRealtimeMeasure, 0, 36};
        case Shader::RealtimeSplit:
            return {kRealtimeSplit, 0, 36};
        case Shader::RealtimeReach:
            return {kRealtimeReach, 0, 36};
        case Shader::RealtimeGather:
            return {kRealtimeGather, 0, 36};
        case Shader::RealtimeCombine16:
            return {kRealtimeCombine16, 0, 36};
        case Shader::RealtimeCombine32:
            break;
    }
    return {kRealtimeCombine32, 0, 36};
}

}  // namespace petzval::device::vulkan
