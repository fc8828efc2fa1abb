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

constexpr std::uint32_t kGather[] =
#include "gather.comp.inc"
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
            return {kAddLights, 6, 32};
        case Shader::Gather:
            break;
    }
    return {kGather, 4, 32};
}

}  // namespace petzval::device::vulkan
