#include "device/vulkan/shaders.h"

namespace petzval::device::vulkan {
namespace {

constexpr std::uint32_t kComposite[] =
#include "composite.comp.inc"
    ;
constexpr std::uint32_t kAddSectors[] =
#include "add_sectors.comp.inc"
    ;

}  // namespace

ShaderWords words_of(Shader shader) {
    switch (shader) {
        case Shader::Composite:
            return {kComposite, 7, 48};
        case Shader::AddSectors:
            break;
    }
    return {kAddSectors, 4, 4};
}

}  // namespace petzval::device::vulkan
