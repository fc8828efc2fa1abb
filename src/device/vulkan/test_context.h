// A device to test on.
#pragma once

#include "device/vulkan/context.h"

#include <memory>

namespace petzval::device::vulkan {

// The first device that can be used; null: there is none.
inline std::shared_ptr<Context> any_context() {
    auto instance = Instance::open();
    if (!instance) return nullptr;
    for (std::size_t i = 0; i < (*instance)->candidates().size(); ++i)
        if (auto context = Context::open(*instance, i)) return *context;
    return nullptr;
}

}  // namespace petzval::device::vulkan
