#include "device/vulkan/develop.h"

#include "base/parallel.h"
#include "device/failure.h"

#include <cstring>

namespace petzval::device::vulkan {
namespace {

struct DevelopPush {
    std::uint32_t row, x0, y0, width, height;  // of the picture, and the part of it
    std::uint32_t pattern_x, pattern_y;
    float exposure, contrast;
    std::uint32_t tone;
    float power;
    std::uint32_t dithers, largest;
};

DevelopPush push_of(const colour::DevelopPlan& plan, int row) {
    const DevelopSettings& settings = plan.settings;
    return {std::uint32_t(row),
            std::uint32_t(plan.part.x0),
            std::uint32_t(plan.part.y0),
            std::uint32_t(plan.part.width()),
            std::uint32_t(plan.part.height()),
            std::uint32_t(plan.x0),
            std::uint32_t(plan.y0),
            plan.exposure(),
            float(settings.contrast),
            std::uint32_t(settings.tone),
            float(colour::power_of(settings.transfer)),
            settings.dither ? 1u : 0u,
            std::uint32_t(plan.largest_code())};
}

// Codes of type Code, stored four per pixel, with the channels that the plan asks for.
template <typename Code>
std::vector<std::uint16_t> unpacked(const std::byte* from, const colour::DevelopPlan& plan,
                                    Workers& workers) {
    const std::size_t channels = plan.channels(), row = std::size_t(plan.part.width());
    std::vector<std::uint16_t> codes(plan.pixels() * channels);
    parallel_for(plan.part.height(), workers, [&](int y) {
        for (std::size_t i = std::size_t(y) * row; i < (std::size_t(y) + 1) * row; ++i) {
            Code pixel[4];
            std::memcpy(pixel, from + i * sizeof(pixel), sizeof(pixel));
            for (std::size_t c = 0; c < channels; ++c) codes[i * channels + c] = pixel[c];
        }
    });
    return codes;
}

}  // namespace

std::vector<std::uint16_t> developed(Context& context, const colour::DevelopPlan& plan,
                                     const DeviceCanvas& picture, Workers& workers) {
    const Piece* const light = picture.away();
    if (!light || plan.part.empty()) return {};
    const bool fits_bytes = plan.settings.bits <= 8;
    const std::size_t bytes = plan.pixels() * (fits_bytes ? 4 : 8);
    try {
        const Piece codes = context.heap().allocate(Kind::OnDevice, bytes);
        Recording recording(context);
        recording.pass("develop", context.program(Shader::Develop), {light, &codes},
                       push_of(plan, picture.width()), invocations(plan.pixels()),
                       {.bytes = plan.pixels() * sizeof(Rgba) + bytes});
        const std::byte* const home = recording.downloaded(codes, bytes);
        recording.run();
        return fits_bytes ? unpacked<std::uint8_t>(home, plan, workers)
                          : unpacked<std::uint16_t>(home, plan, workers);
    } catch (const Failed& failed) {
        if (failed.error.code != ErrorCode::OutOfMemory) throw;
        return {};
    }
}

}  // namespace petzval::device::vulkan
