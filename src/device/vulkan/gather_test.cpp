#include "device/vulkan/gather.h"

#include "device/failure.h"
#include "device/vulkan/driver/test_context.h"
#include "engine/gather/plan.h"
#include "kernel/lenses/make_lens.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

// A row of tiles at two radii, of the picture and of cells.
class Drawn {
public:
    explicit Drawn(int width) : colour_(width, kHeight), coc_px_(width, kHeight, 2.0f) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < width; ++x) {
                colour_(x, y) = {float((7 * x + 3 * y) % 11) / 11, float((x * y) % 7) / 7, 0.3f, 1};
                if (x % 150 > 90) coc_px_(x, y) = 12;
            }
        for (int level = 0; level < 6; ++level)
            lenses_.push_back(
                std::move(
                    kernel::make_lens({}, kernel::Mount{{50, 36, 1.4, 2}, width >> level, kHeight >> level}))
                    .value());
        input_.lens.levels = lenses_;
        input_.lens.field_per_px = 2 / std::hypot(width, kHeight);
        input_.samples.colour = colour_, input_.samples.coc_px = coc_px_, input_.lens.frame = colour_.rect();
        input_.samples.farthest_coc_px = 12, input_.services.progress = &progress_;
    }
    Picture by(Context& context) {
        const engine::RingSizes sizes(0, 12, engine::ring_rule(Quality::Standard), input_.lens, true);
        const engine::RingKernels kernels(input_.lens, sizes);
        const engine::GatherPlan plan = engine::plan_gather(input_, colour_.rect(), 0, sizes, kernels);
        Memory memory(std::numeric_limits<std::size_t>::max());
        const Control control{*input_.services.workers, progress_};
        Picture out(colour_.width(), kHeight);
        gather_tiles(context, plan,
                     PackedAtlas(laid_out<PackedSet>(kernels, plan.kernels, "test", memory, control)), out,
                     control);
        return out;
    }

private:
    static constexpr int kHeight = 32;
    Picture colour_;
    Plane coc_px_;
    std::vector<std::unique_ptr<const kernel::LensModel>> lenses_;
    Progress progress_;
    engine::EngineView input_;
};

std::uint64_t bytes_of(const Context& context) {
    std::uint64_t bytes = 0;
    for (const PassTime& pass : context.pass_times()) bytes += pass.work.bytes;
    return bytes;
}

// Tile by tile, as on a device that is slow or has little memory: each takes what it needs of the picture,
// however wide that is.
TEST(Gather, IsTheSameBitsTileByTileAtTheSameCostAPixel) {
    const auto context = any_context(), slow = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    while (slow->at_once(16) > 1) slow->halves(Failed{{ErrorCode::OutOfMemory, ""}});
    Drawn narrow(256), wide(900);
    slow->time_passes();
    narrow.by(*slow);
    const std::uint64_t of_narrow = bytes_of(*slow);
    slow->time_passes();
    const Picture tiles = wide.by(*slow), whole = wide.by(*context);
    EXPECT_LT(double(bytes_of(*slow)) / 900, 1.3 * double(of_narrow) / 256);
    EXPECT_EQ(std::memcmp(whole.pixels(), tiles.pixels(), whole.bytes()), 0);
    EXPECT_GT(whole(600, 20).a, 0.99f);
}

}  // namespace
}  // namespace petzval::device::vulkan
