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

class RememberedLens final : public LensModel {
public:
    RememberedLens(std::unique_ptr<const LensModel> lens, std::size_t max_bytes)
        : lens_(std::move(lens)), cache_(max_bytes) {}

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override {
        const Mirrors mirrors = lens_->mirrors();
        Asked asked{coc_radius_px + 0.0, rounded(field.x), rounded(field.y)};
        const bool left_right = mirrors.left_right && asked.field_x > 0;
        const bool up_down = mirrors.up_down && asked.field_y > 0;
        if (left_right) asked.field_x *= -1;
        if (up_down) asked.field_y *= -1;
        if (!lens_->varies_over_field()) asked.field_x = asked.field_y = 0;
        const auto kernel = cache_.get(asked, [&] {
            return lens_->point_spread(asked.coc_radius_px, {asked.field_x, asked.field_y});
        });
        return mirrored(*kernel, left_right, up_down);
    }
    PointSpread raw_point_spread(double coc_radius_px, FieldPosition field) const override {
        return lens_->raw_point_spread(coc_radius_px, field);
    }
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override {
        return lens_->rays(count, field, seed);
    }
    double reach_px(double coc_radius_px) const override { return lens_->reach_px(coc_radius_px); }
    bool varies_over_field() const override { return lens_->varies_over_field(); }
    Mirrors mirrors() const override { return lens_->mirrors(); }
    std::string description() const override { return lens_->description(); }
    bool is_quick() const override { return false; }

private:
    // To 2^-24, so that places that mirror each other but for rounding are the same; never -0.
    static double rounded(double field) {
        return std::ldexp(std::nearbyint(std::ldexp(field, 24)), -24) + 0.0;
    }

    std::unique_ptr<const LensModel> lens_;
    mutable KernelCache<Asked> cache_;
};

}  // namespace

std::unique_ptr<const LensModel> remembered(std::unique_ptr<const LensModel> lens, std::size_t max_bytes) {
    if (lens->is_quick()) return lens;
    return std::make_unique<RememberedLens>(std::move(lens), max_bytes);
}

}  // namespace petzval::kernel
