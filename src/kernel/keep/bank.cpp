#include "kernel/keep/bank.h"

#include "base/check.h"
#include "base/parallel.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace petzval::kernel {
namespace {

std::uint64_t key_of(int step, int cell) {
    return (std::uint64_t(std::uint32_t(step)) << 32) | std::uint32_t(cell);
}

}  // namespace

KernelBank::KernelBank(const LensModel& lens, const BankOptions& options)
    : lens_(lens), options_(options), cache_(options.max_bytes) {
    PETZVAL_CHECK(options.columns > 0 && options.rows > 0 && options.aspect > 0);
    PETZVAL_CHECK(options.relative_step > 0 && options.least_step_px > 0);
    if (!lens.varies_over_field()) options_.columns = options_.rows = 1;
    // Even steps until the next would be narrower than the relative one.
    linear_steps_ = std::max(1, int(std::floor(1 / options.relative_step)));
    linear_end_px_ = linear_steps_ * options.least_step_px;
    half_height_ = 1 / std::hypot(1.0, options.aspect);
    half_width_ = options.aspect * half_height_;
}

int KernelBank::step_of(double coc_radius_px) const {
    const double radius = std::abs(coc_radius_px);
    const double step = radius <= linear_end_px_ ? radius / options_.least_step_px
                                                 : linear_steps_ + std::log(radius / linear_end_px_) /
                                                                       std::log1p(options_.relative_step);
    return int(std::lround(std::copysign(step, coc_radius_px)));
}

double KernelBank::radius_of(int step) const {
    const int count = std::abs(step);
    const double radius = count <= linear_steps_
                              ? count * options_.least_step_px
                              : linear_end_px_ * std::pow(1 + options_.relative_step, count - linear_steps_);
    return std::copysign(radius, double(step));
}

KernelBank::Cells KernelBank::cells_of(int step) const {
    Cells cells{options_.columns, options_.rows};
    if (cells.columns * cells.rows == 1 || options_.largest_rim_step_px <= 0) return cells;
    constexpr int kMostColumns = 4096;
    const double rim_px = lens_.reach_px(radius_of(step)) * 2 * half_width_;  // from one side to the other
    while (rim_px > options_.largest_rim_step_px * cells.columns && cells.columns < kMostColumns)
        cells = {2 * cells.columns, 2 * cells.rows};
    return cells;
}

int KernelBank::cell_of(const Cells& cells, FieldPosition field) const {
    const auto index = [](double at, int count) {
        return std::clamp(int(std::floor(at * count)), 0, count - 1);
    };
    const int column = index(0.5 + 0.5 * field.x / half_width_, cells.columns);
    const int row = index(0.5 + 0.5 * field.y / half_height_, cells.rows);
    return row * cells.columns + column;
}

FieldPosition KernelBank::middle_of(const Cells& cells, int cell) const {
    const int column = cell % cells.columns, row = cell / cells.columns;
    // Exactly 0 in the middle cell, whose kernel may be simpler.
    return {half_width_ * (2 * column + 1 - cells.columns) / cells.columns,
            half_height_ * (2 * row + 1 - cells.rows) / cells.rows};
}

std::shared_ptr<const PointSpread> KernelBank::kernel_of(int step, int cell) const {
    return cache_.get(key_of(step, cell), [&] { return made(step, cell); });
}

// Cells right of and above the middle mirror those on the other side, where the lens allows it.
PointSpread KernelBank::made(int step, int cell) const {
    const Cells cells = cells_of(step);
    const int column = cell % cells.columns, row = cell / cells.columns;
    const Mirrors mirrors = lens_.mirrors();
    const bool left_right = mirrors.left_right && 2 * column > cells.columns - 1;
    const bool up_down = mirrors.up_down && 2 * row > cells.rows - 1;
    if (!left_right && !up_down) return lens_.point_spread(radius_of(step), middle_of(cells, cell));
    const int twin = (up_down ? cells.rows - 1 - row : row) * cells.columns +
                     (left_right ? cells.columns - 1 - column : column);
    return mirrored(*kernel_of(step, twin), left_right, up_down);
}

void KernelBank::prepare(double least_coc_px, double largest_coc_px, Workers& workers) const {
    const int first = step_of(least_coc_px), last = step_of(largest_coc_px);
    std::vector<std::pair<int, int>> keys;  // large kernels first: they take longest
    for (int k = 0; k <= last - first; ++k) {
        const int step = k % 2 == 0 ? first + k / 2 : last - k / 2;
        const Cells cells = cells_of(step);
        for (int cell = 0; cell < cells.columns * cells.rows; ++cell) keys.emplace_back(step, cell);
    }
    parallel_for(int(keys.size()), workers, [&](int i) {
        if (cache_.bytes() > options_.max_bytes * 9 / 10) return;
        kernel_of(keys[std::size_t(i)].first, keys[std::size_t(i)].second);
    });
}

}  // namespace petzval::kernel
