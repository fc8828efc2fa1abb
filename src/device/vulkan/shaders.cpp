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
            return {kGather, 4, 32};
        case Shader::SpreadCells:
            return {kSpreadCells, 5, 84};
        case Shader::BlurCells:
            return {kBlurCells, 5, 84};
        case Shader::MixBlurs:
            break;
    }
    return {kMixBlurs, 6, 84};
}

}  // namespace petzval::device::vulkan
