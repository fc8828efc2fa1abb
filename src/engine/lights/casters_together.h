// Occluders that are compared with a light together, a register at a time.
#pragma once

#include "engine/lights/shadow_plan.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <span>

namespace petzval::engine {

// Casters of several ranges: registers are full, although most ranges are short. Each caster is stored as two
// halves of four numbers, which registers load transposed; both halves have the radius.
class CastersTogether {
public:
    static constexpr std::size_t kMost = 128, kHalf = 4;

    // Adds as many of them as there is room for, and returns their number.
    std::size_t add(std::span<const Caster> casters) {
        static_assert(sizeof(Caster) == 28 && offsetof(Caster, coc_px) == 12);
        const std::size_t n = casters.size() < kMost - count_ ? casters.size() : kMost - count_;
        float *first = &first_[kHalf * count_], *second = &second_[kHalf * count_];
        for (std::size_t i = 0; i < n; ++i, first += kHalf, second += kHalf) {
            const auto* const bytes = reinterpret_cast<const std::byte*>(&casters[i]);
            std::memcpy(first, bytes, kHalf * sizeof(float));
            std::memcpy(second, bytes + offsetof(Caster, coc_px), kHalf * sizeof(float));
        }
        count_ += n;
        return n;
    }
    std::size_t size() const { return count_; }
    void clear() { count_ = 0; }
    const float* first_halves() const { return first_.data(); }    // x, y, size, coc_px
    const float* second_halves() const { return second_.data(); }  // coc_px, coverage, right_px, down_px

    // Writes those that the viewpoint sees (law_sees) to `out`, in their order, and returns their number.
    std::size_t seen_from(const Viewpoint& view, const OpenSides& edges, float pupil_end,
                          SeenCaster* out) const;

private:
    alignas(64) std::array<float, kMost * kHalf> first_;
    alignas(64) std::array<float, kMost * kHalf> second_;
    std::size_t count_ = 0;
};

}  // namespace petzval::engine
