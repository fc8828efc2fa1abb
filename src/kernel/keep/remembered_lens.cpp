#include "kernel/keep/remembered_lens.h"

#include "kernel/keep/kernel_cache.h"
#include "kernel/model/spread.h"

#include <cmath>
#include <compare>
#include <utility>

namespace petzval::kernel {
namespace {

struct Asked {
    double coc_radius_px, field_x, field_y;
    friend auto operator<=>(const Asked&, const Asked&) = default;  // NOLINT(modernize-use-nullptr): not one
};

class RememberedLens final : public LensOver {
public:
    RememberedLens(std::unique_ptr<const LensModel> lens, std::size_t max_bytes)
        : LensOver(std::move(lens)), cache_(max_bytes) {}

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override {
        const Mirrors mirrors = under().mirrors();
        Asked asked{coc_radius_px + 0.0, rounded(field.x), rounded(field.y)};
        const bool left_right = mirrors.left_right && asked.field_x > 0;
        const bool up_down = mirrors.up_down && asked.field_y > 0;
        if (left_right) asked.field_x *= -1;
        if (up_down) asked.field_y *= -1;
        if (!under().varies_over_field()) asked.field_x = asked.field_y = 0;
        const auto kernel = cache_.get(asked, [&] {
            return under().point_spread(asked.coc_radius_px, {asked.field_x, asked.field_y});
        });
        return mirrored(*kernel, left_right, up_down);
    }

private:
    // To 2^-24, so that places that mirror each other but for rounding are the same; never -0.
    static double rounded(double field) {
        return std::ldexp(std::nearbyint(std::ldexp(field, 24)), -24) + 0.0;
    }

    mutable KernelCache<Asked> cache_;
};

}  // namespace

std::unique_ptr<const LensModel> remembered(std::unique_ptr<const LensModel> lens, std::size_t max_bytes) {
    if (lens->is_quick()) return lens;
    return std::make_unique<RememberedLens>(std::move(lens), max_bytes);
}

}  // namespace petzval::kernel
