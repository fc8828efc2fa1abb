#include "session/frame_codes.h"

#include "colour/develop_plan.h"
#include "device/cpu/cpu_device.h"

#include <algorithm>
#include <utility>

namespace petzval {
namespace {

// Rows of a part, put into a window that is larger.
std::vector<std::uint16_t> framed(const std::vector<std::uint16_t>& codes, const Rect& part,
                                  const Rect& window, std::size_t channels) {
    const std::size_t row = std::size_t(window.width()) * channels,
                      part_row = std::size_t(part.width()) * channels;
    std::vector<std::uint16_t> all(row * std::size_t(window.height()));
    for (std::size_t y = 0; y < std::size_t(part.height()); ++y)
        std::copy_n(codes.data() + y * part_row, part_row,
                    all.data() + (y + std::size_t(part.y0 - window.y0)) * row +
                        std::size_t(part.x0 - window.x0) * channels);
    return all;
}

}  // namespace

FrameCodes codes_of(device::Canvas& picture, const Rect& lies, const Rect& asked, const CodesWanted& wanted,
                    const device::Device& device, Workers& workers) {
    const Rect& window = wanted.window;
    const Rect part = asked.intersected(window);
    const colour::DevelopPlan plan{wanted.develop, part.moved(-lies.x0, -lies.y0), part.x0 - window.x0,
                                   part.y0 - window.y0};
    FrameCodes made{.codes = {}, .device = device.name()};
    if (part.empty()) return {framed({}, {}, window, plan.channels()), device::cpu_device().name()};
    made.codes = device.develop(plan, picture, workers);
    if (made.codes.empty()) {
        made.device = device::cpu_device().name();
        made.codes = device::cpu_device().develop(plan, picture, workers);
    }
    if (part != window) made.codes = framed(made.codes, part, window, plan.channels());
    return made;
}

}  // namespace petzval
