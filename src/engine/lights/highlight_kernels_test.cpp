#include "engine/lights/highlight_kernels.h"

#include "kernel/lenses/make_lens.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

class Counted final : public kernel::LensOver {
public:
    Counted(std::unique_ptr<const kernel::LensModel> lens, std::atomic<int>& made, bool quick)
        : LensOver(std::move(lens)), made_(made), quick_(quick) {}
    kernel::PointSpread point_spread(double coc_radius_px, FieldPosition field) const override {
        ++made_;
        return under().point_spread(coc_radius_px, field);
    }
    bool is_quick() const override { return quick_; }

private:
    std::atomic<int>& made_;
    bool quick_;
};

class WideDiscs : public testing::Test {
protected:
    static constexpr int kWidth = 1920, kHeight = 1080, kLevels = 4;

    HighlightKernels kernels(bool quick) {
        LensChoice choice;
        choice.name = "ideal";
        choice.cats_eye = 0.5;
        for (int l = 0; l < kLevels; ++l) {
            const kernel::Mount on_level{{50, 36, 1.4, 2}, kWidth >> l, kHeight >> l};
            levels_.push_back(std::make_unique<Counted>(kernel::make_lens(choice, on_level).value(),
                                                        l == 0 ? on_pixels_ : on_cells_, quick));
        }
        input_.lens.levels = levels_, input_.lens.frame = {0, 0, kWidth, kHeight};
        return HighlightKernels(input_);
    }
    static std::shared_ptr<const kernel::PointSpread> of(const HighlightKernels& kernels, float coc_px,
                                                         Seen seen, int size = 1) {
        const Highlight lamp{300, 200, size, coc_px, {1, 1, 1, 0}};
        const device::KernelAsk asks[] = {kernels.ask(lamp, kField, seen)};
        return kernels.make(asks)[0][0];
    }
    static constexpr FieldPosition kField{-0.6, -0.3};

    std::vector<std::unique_ptr<const kernel::LensModel>> levels_;
    EngineView input_;
    std::atomic<int> on_pixels_ = 0, on_cells_ = 0;
};

TEST_F(WideDiscs, DimOnesAreMadeOnCellsAndLookTheSame) {
    const HighlightKernels lamps = kernels(false);
    for (const float coc_px : {70.0f, 130.0f, 250.0f, -250.0f, 600.0f}) {
        const auto dim = of(lamps, coc_px, Seen::Nothing);
        EXPECT_EQ(on_pixels_, 0) << coc_px;
        const auto bright = of(lamps, coc_px, Seen::DiscAndRim);
        on_pixels_ = 0;
        double apart = 0;
        const Rect e = bright->extent.grown(8);
        for (int y = e.y0; y < e.y1; ++y)
            for (int x = e.x0; x < e.x1; ++x) {
                const auto at = [&](const kernel::PointSpread& spread) {
                    const Rect& in = spread.extent;
                    return in.contains(x, y) ? spread.weights(x - in.x0, y - in.y0).g : 0.0f;
                };
                apart += double(std::abs(at(*dim) - at(*bright)));
            }
        EXPECT_LT(apart, 0.03) << coc_px;  // of the light, within a part of a cell of the rim
    }
}

TEST_F(WideDiscs, BrightOrNarrowOnesAreMadeOnPixels) {
    const HighlightKernels lamps = kernels(false);
    of(lamps, 250, Seen::Disc), of(lamps, 250, Seen::DiscAndRim), of(lamps, 60, Seen::Nothing);
    EXPECT_EQ(on_pixels_, 3);
    EXPECT_EQ(on_cells_, 0);
    of(lamps, 70, Seen::Nothing);
    EXPECT_EQ(on_cells_, 1);
}

TEST_F(WideDiscs, OfQuickLensesAreMadeOnPixels) {
    of(kernels(true), 250, Seen::Nothing);
    EXPECT_EQ(on_pixels_, 1);
    levels_.clear();
    of(kernels(false), 250, Seen::Nothing);
    EXPECT_EQ(on_pixels_, 1);
    EXPECT_EQ(on_cells_, 1);
}

TEST_F(WideDiscs, OfSquaresAreWiderByTheSquare) {
    const HighlightKernels lamps = kernels(false);
    const Rect of_pixel = of(lamps, 250, Seen::Nothing)->extent;
    const Rect of_square = of(lamps, 250, Seen::Nothing, 4)->extent;
    EXPECT_EQ(of_square, (Rect{of_pixel.x0, of_pixel.y0, of_pixel.x1 + 3, of_pixel.y1 + 3}));
    EXPECT_EQ(on_pixels_, 0);
}

}  // namespace
}  // namespace petzval::engine
