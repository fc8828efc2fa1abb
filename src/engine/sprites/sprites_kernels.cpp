#include "engine/sprites/sprites_kernels.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// Radii are rounded to an eighth of a pixel, and to 1 % where that is more.
constexpr float kLeastStepPx = 0.125f, kRelativeStep = 0.01f;
constexpr float kLinearEndPx = kLeastStepPx / kRelativeStep;
constexpr int kLinearSteps = int(kLinearEndPx / kLeastStepPx);
// Parts of the picture, where the lens varies: so many that the rim of the largest disc moves by no more than
// this from one to the next, as long as their kernels fit.
constexpr double kRimStepPx = 0.5;
constexpr int kFewestColumns = 9, kMostColumns = 144;
constexpr std::size_t kMostBytes = std::size_t(256) << 20;

float largest_cells(Quality quality) {
    return quality == Quality::Draft ? 16.0f : quality == Quality::Standard ? 32.0f : 64.0f;
}

// A kernel moved right and down by part of a cell, bilinear.
kernel::PointSpread moved(const kernel::PointSpread& spread, float right, float down) {
    if (right == 0 && down == 0) {
        return {spread.extent, spread.weights.clone(), spread.neutral};
    }
    const Rect e{spread.extent.x0, spread.extent.y0, spread.extent.x1 + 1, spread.extent.y1 + 1};
    kernel::PointSpread result{e, Image<Rgba>(e.width(), e.height()), spread.neutral};
    for (int y = 0; y < spread.weights.height(); ++y)
        for (int x = 0; x < spread.weights.width(); ++x) {
            const Rgba w = spread.weights(x, y);
            result.weights(x, y) += ((1 - right) * (1 - down)) * w;
            result.weights(x + 1, y) += (right * (1 - down)) * w;
            result.weights(x, y + 1) += ((1 - right) * down) * w;
            result.weights(x + 1, y + 1) += (right * down) * w;
        }
    return result;
}

// What a kernel gains in variance per axis, cells^2, by being moved: t (1 - t), the mean of both axes.
double moving_blur(float right, float down) { return 0.5 * double(right * (1 - right) + down * (1 - down)); }

// Enlarging from cells s wide blurs by (s^2 - 1)/4 px^2 per axis more than a pixel does (gather_rings.cpp),
// moving by `extra` cells^2; a disc's variance is r^2/4.
double radius_in_cells(double radius_px, int level, double extra = 0) {
    const double s = std::ldexp(1.0, level);
    const double squared = (radius_px * radius_px - (s * s - 1)) / (s * s) - 4 * extra;
    return std::copysign(std::sqrt(std::max(0.0, squared)), radius_px);
}

}  // namespace

SpriteKernels::SpriteKernels(const Input& input, std::span<const Sprite> sprites)
    : input_(input), largest_cells_(largest_cells(input.quality)) {
    float largest_px = 0;
    for (const Sprite& s : sprites) largest_px = std::max(largest_px, std::abs(s.coc_px));
    steps_ = step_of(largest_px) + 1;
    levels_ = level_of(radius_of(steps_ - 1)) + 1;
    for (int level = 0; level < levels_; ++level) {
        const double widest =
            std::min(double(radius_of(steps_ - 1)), std::ldexp(double(largest_cells_), level));
        reach_.push_back(int(std::ceil(input.lens(level).reach_px(radius_in_cells(widest, level)) + 0.5)) +
                         1);
    }
    // Kernels of lenses that change over the picture are many: those lights are put at whole pixels.
    if (input.lens(0).varies_over_field()) {
        phases_ = 1;
        choose_parts(sprites, largest_px);
    }
    kernels_ = std::vector<std::atomic<const StampKernel*>>(count());
}

void SpriteKernels::choose_parts(std::span<const Sprite> sprites, float largest_px) {
    const double across = std::abs(input_.field_at(input_.frame.width(), 0).x - input_.field_at(0, 0).x);
    const double rim_px = input_.lens(0).reach_px(double(largest_px)) * across;
    int columns =
        int(std::clamp(std::ceil(rim_px / kRimStepPx), double(kFewestColumns), double(kMostColumns)));
    for (;; columns = std::max(kFewestColumns, columns * 2 / 3)) {
        parts_x_ = columns;
        parts_y_ = std::max(6, columns * input_.frame.height() / input_.frame.width());
        if (columns == kFewestColumns || bytes_for(sprites) <= kMostBytes) return;
    }
}

std::size_t SpriteKernels::count() const {
    return std::size_t(parts_x_ * parts_y_) * std::size_t(2 * steps_) * std::size_t(phases_ * phases_);
}

// Of the kernels that the lights take, with the table that holds them.
std::size_t SpriteKernels::bytes_for(std::span<const Sprite> sprites) const {
    std::vector<bool> seen(count());
    std::size_t bytes = count() * sizeof(kernels_[0]);
    for (const Sprite& s : sprites) {
        const Stamping stamping = this->stamping(s.x, s.y, s.coc_px);
        if (seen[std::size_t(stamping.kernel)]) continue;
        seen[std::size_t(stamping.kernel)] = true;
        const double cells = radius_in_cells(double(s.coc_px), stamping.level);
        const double side = 2 * input_.lens(stamping.level).reach_px(cells) + 3;
        bytes += std::size_t(side * side) * sizeof(Rgba);
    }
    return bytes;
}

SpriteKernels::~SpriteKernels() {
    for (auto& kernel : kernels_) delete kernel.load();
}

int SpriteKernels::step_of(float radius_px) {
    if (radius_px <= kLinearEndPx) return int(radius_px / kLeastStepPx + 0.5f);
    return kLinearSteps + int(std::log(radius_px / kLinearEndPx) / std::log1p(kRelativeStep) + 0.5f);
}

float SpriteKernels::radius_of(int step) {
    if (step <= kLinearSteps) return kLeastStepPx * float(step);
    return kLinearEndPx * std::pow(1 + kRelativeStep, float(step - kLinearSteps));
}

int SpriteKernels::level_of(float radius_px) const {
    return radius_px <= largest_cells_ ? 0 : int(std::ceil(std::log2(radius_px / largest_cells_) - 1e-4f));
}

Stamping SpriteKernels::stamping(float x, float y, float coc_px) const {
    const int step = std::min(step_of(std::abs(coc_px)), steps_ - 1);
    Stamping s;
    s.level = level_of(radius_of(step));
    const float per_cell = 1 / float(1 << s.level);
    const auto place = [&](float at, int& cell) {
        const int quarters = int(std::floor((at * per_cell - 0.5f) * float(phases_) + 0.5f));
        cell = int(std::floor(float(quarters) / float(phases_)));
        return quarters - cell * phases_;
    };
    const int phase_x = place(x, s.x), phase_y = place(y, s.y);
    const int px = std::clamp(
        int((x - float(input_.frame.x0)) / float(input_.frame.width()) * float(parts_x_)), 0, parts_x_ - 1);
    const int py = std::clamp(
        int((y - float(input_.frame.y0)) / float(input_.frame.height()) * float(parts_y_)), 0, parts_y_ - 1);
    const int side = coc_px < 0 ? 0 : 1;
    s.kernel =
        (((py * parts_x_ + px) * 2 + side) * steps_ + step) * phases_ * phases_ + phase_y * phases_ + phase_x;
    return s;
}

kernel::PointSpread SpriteKernels::spread(int kernel) const {
    const int phase = kernel % (phases_ * phases_), radius = kernel / (phases_ * phases_);
    const int step = radius % steps_, side = radius / steps_ % 2, part = radius / steps_ / 2;
    const double signed_radius = (side ? 1 : -1) * double(radius_of(step));
    const int level = level_of(radius_of(step));
    const int column = part % parts_x_, row = part / parts_x_;
    const double x = input_.frame.x0 + (column + 0.5) * input_.frame.width() / parts_x_ - 0.5;
    const double y = input_.frame.y0 + (row + 0.5) * input_.frame.height() / parts_y_ - 0.5;
    const int right = phase % phases_, down = phase / phases_;
    const float by_x = float(right) / float(phases_), by_y = float(down) / float(phases_);
    const double radius_cells = radius_in_cells(signed_radius, level, moving_blur(by_x, by_y));
    return moved(input_.lens(level).point_spread(radius_cells, input_.field_at(x, y)), by_x, by_y);
}

const StampKernel& SpriteKernels::at(int kernel) const {
    std::atomic<const StampKernel*>& slot = kernels_[std::size_t(kernel)];
    if (const StampKernel* made = slot.load(std::memory_order_acquire)) return *made;
    auto made = std::make_unique<const StampKernel>(spread(kernel));
    const StampKernel* expected = nullptr;
    if (slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *made.release();
    return *expected;  // another thread was first, with the same kernel
}

}  // namespace petzval::engine
