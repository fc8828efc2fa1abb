#include "kernel/keep/remembered_lens.h"

#include "kernel/model/spread.h"

#include <cmath>
#include <utility>

namespace petzval::kernel {
namespace {

class RememberedLens final : public LensOver {
public:
    RememberedLens(std::unique_ptr<const LensModel> lens, std::shared_ptr<RememberedKernels> kernels,
                   int number)
        : LensOver(std::move(lens)), kernels_(std::move(kernels)), number_(number) {}

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override {
        const Mirrors mirrors = under().mirrors();
        RememberedKernel asked{number_, coc_radius_px + 0.0, rounded(field.x), rounded(field.y)};
        const bool left_right = mirrors.left_right && asked.field_x > 0;
        const bool up_down = mirrors.up_down && asked.field_y > 0;
        if (left_right) asked.field_x *= -1;
        if (up_down) asked.field_y *= -1;
        if (!under().varies_over_field()) asked.field_x = asked.field_y = 0;
        const auto kernel = kernels_->get(asked, [&] {
            return under().point_spread(asked.coc_radius_px, {asked.field_x, asked.field_y});
        });
        return mirrored(*kernel, left_right, up_down);
    }

private:
    // Rounds to 2^-24, so that mirrored places that differ by rounding are the same; never -0.
    static double rounded(double field) {
        return std::ldexp(std::nearbyint(std::ldexp(field, 24)), -24) + 0.0;
    }

    std::shared_ptr<RememberedKernels> kernels_;
    int number_;
};

}  // namespace

std::unique_ptr<const LensModel> remembered(std::unique_ptr<const LensModel> lens,
                                            std::shared_ptr<RememberedKernels> kernels, int number) {
    if (lens->is_quick()) return lens;
    return std::make_unique<RememberedLens>(std::move(lens), std::move(kernels), number);
}

}  // namespace petzval::kernel
