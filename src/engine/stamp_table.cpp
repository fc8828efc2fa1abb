#include "engine/stamp_table.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kStepsPerCell = 16;
constexpr int kPartsX = 9, kPartsY = 6;

}  // namespace

StampTable::StampTable(const Input& input, float largest_radius)
    : input_(input), steps_(int(std::ceil(largest_radius * kStepsPerCell)) + 2) {
    if (input.lens(0).varies_over_field()) parts_x_ = kPartsX, parts_y_ = kPartsY;
    const int levels = int(input.lens_levels.size());
    for (int l = 0; l < levels; ++l)
        reach_.push_back(int(std::ceil(input.lens(l).reach_px(double(largest_radius)) + 0.5)));
    kernels_ =
        std::vector<std::atomic<const StampKernel*>>(std::size_t(levels * parts_x_ * parts_y_ * 2 * steps_));
}

StampTable::~StampTable() {
    for (auto& kernel : kernels_) delete kernel.load();
}

int StampTable::part_for(int level, int x, int y) const {
    if (parts_x_ * parts_y_ == 1) return 0;
    // Numbers 0…1 that fill every neighbourhood evenly: multiples of powers of the roots of x^3 = x + 1 and
    // x^4 = x + 1 (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
    const auto even = [&](double per_x, double per_y) {
        const double sum = x * per_x + y * per_y;
        return sum - std::floor(sum);
    };
    const auto index = [](double place, double chance, int count) {
        return std::clamp(int(std::floor(place - 0.5 + chance)), 0, count - 1);
    };
    const double px = std::ldexp(x + 0.5, level) / input_.width() * parts_x_;
    const double py = std::ldexp(y + 0.5, level) / input_.height() * parts_y_;
    return index(py, even(0.8191725134, 0.6710436067), parts_y_) * parts_x_ +
           index(px, even(0.7548776662, 0.5698402910), parts_x_);
}

const StampKernel& StampTable::at(int level, int part, float radius) const {
    const int step = std::min(int(std::abs(radius) * kStepsPerCell + 0.5f), steps_ - 1);
    const int side = radius < 0 ? 0 : 1;
    std::atomic<const StampKernel*>& slot =
        kernels_[std::size_t(((level * parts_x_ * parts_y_ + part) * 2 + side) * steps_ + step)];
    if (const StampKernel* kernel = slot.load(std::memory_order_acquire)) return *kernel;

    const int column = part % parts_x_, row = part / parts_x_;
    const double middle_x = (column + 0.5) * input_.width() / parts_x_ - 0.5;
    const double middle_y = (row + 0.5) * input_.height() / parts_y_ - 0.5;
    const double signed_radius = (side ? 1 : -1) * double(step) / double(kStepsPerCell);
    auto made = std::make_unique<const StampKernel>(
        input_.lens(level).point_spread(signed_radius, input_.field_at(middle_x, middle_y)));
    const StampKernel* expected = nullptr;
    if (slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *made.release();
    return *expected;  // another thread was first, with the same kernel
}

}  // namespace petzval::engine
