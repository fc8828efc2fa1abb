#include "engine/lights/sprite_kernels.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace petzval::engine {
namespace {

// Radii are rounded to an eighth of a pixel, and to 1 % where that is more.
constexpr float kLeastStepPx = 0.125f, kRelativeStep = 0.01f;
constexpr float kLinearEndPx = kLeastStepPx / kRelativeStep;
constexpr int kLinearSteps = int(kLinearEndPx / kLeastStepPx);
constexpr int kFarSteps = 1 << 16;  // steps of radii behind focus begin here
// Parts of the picture, where the lens varies: so many that the rim of the largest disc moves by no more than
// this from one to the next, as long as their kernels fit.
constexpr double kRimStepPx = 0.5;
constexpr int kFewestColumns = 9, kMostColumns = 144;
constexpr std::size_t kMostBytes = std::size_t(256) << 20;

float largest_cells(Quality quality) {
    return quality == Quality::Draft ? 16.0f : quality == Quality::Standard ? 32.0f : 64.0f;
}

// A kernel moved right and down by part of a cell, bilinear.
kernel::PointSpread moved(kernel::PointSpread spread, float right, float down) {
    if (right == 0 && down == 0) return spread;
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

// Variance per axis that moving adds to a kernel, cells^2: t (1 - t), the mean of both axes.
double moving_blur(float right, float down) { return 0.5 * double(right * (1 - right) + down * (1 - down)); }

// Enlarging from cells s wide blurs by (s^2 - 1)/4 px^2 per axis more than a pixel does (gather_rings.cpp),
// moving by `extra` cells^2; a disc's variance is r^2/4.
double radius_in_cells(double radius_px, int level, double extra = 0) {
    const double s = std::ldexp(1.0, level);
    const double squared = (radius_px * radius_px - (s * s - 1)) / (s * s) - 4 * extra;
    return std::copysign(std::sqrt(std::max(0.0, squared)), radius_px);
}

int step_of(float radius_px) {
    if (radius_px <= kLinearEndPx) return int(radius_px / kLeastStepPx + 0.5f);
    return kLinearSteps + int(std::log(radius_px / kLinearEndPx) / std::log1p(kRelativeStep) + 0.5f);
}

float radius_of(int step) {
    if (step <= kLinearSteps) return kLeastStepPx * float(step);
    return kLinearEndPx * std::pow(1 + kRelativeStep, float(step - kLinearSteps));
}

}  // namespace

SpriteGrid::SpriteGrid(const EngineView& input, std::span<const Sprite> sprites)
    : frame_(input.lens.frame),
      largest_cells_(largest_cells(input.options.quality)),
      pixels_per_radius_(std::max(1.0f, float(input.lens.level(0).reach_px(1000) / 1000))) {
    float largest_px = 0;
    for (const Sprite& s : sprites) largest_px = std::max(largest_px, std::abs(s.coc_px));
    steps_ = step_of(largest_px) + 1;
    const float widest_px = radius_of(steps_ - 1);
    for (int level = 0; level <= level_of(widest_px); ++level) {
        const double widest = std::min(double(widest_px), std::ldexp(double(largest_cells_), level));
        reach_.push_back(
            int(std::ceil(input.lens.level(level).reach_px(radius_in_cells(widest, level)) + 0.5)) + 1);
    }
    // Kernels of lenses that change over the picture are many: those lights are put at whole pixels.
    if (input.lens.level(0).varies_over_field()) {
        phases_ = 1;
        choose_parts(input, sprites, largest_px);
    }
}

void SpriteGrid::choose_parts(const EngineView& input, std::span<const Sprite> sprites, float largest_px) {
    const double across = std::abs(input.lens.field_at(frame_.width(), 0).x - input.lens.field_at(0, 0).x);
    const double rim_px = input.lens.level(0).reach_px(double(largest_px)) * across;
    int columns =
        int(std::clamp(std::ceil(rim_px / kRimStepPx), double(kFewestColumns), double(kMostColumns)));
    for (;; columns = std::max(kFewestColumns, columns * 2 / 3)) {
        columns_ = columns;
        rows_ = std::max(6, columns * frame_.height() / frame_.width());
        if (columns == kFewestColumns || bytes_for(input, sprites) <= kMostBytes) return;
    }
}

std::size_t SpriteGrid::count() const {
    return std::size_t(columns_ * rows_) * std::size_t(2 * steps_) * std::size_t(phases_ * phases_);
}

// Bytes of the lights' kernels, with their index.
std::size_t SpriteGrid::bytes_for(const EngineView& input, std::span<const Sprite> sprites) const {
    std::vector<bool> seen(count());
    std::size_t bytes = count() * sizeof(void*);
    for (const Sprite& s : sprites) {
        const auto where = place(s.x, s.y, s.coc_px);
        if (seen[where.kernel]) continue;
        seen[where.kernel] = true;
        const double side =
            2 * input.lens.level(where.level).reach_px(radius_in_cells(double(s.coc_px), where.level)) + 3;
        bytes += std::size_t(side * side) * sizeof(Rgba);
    }
    return bytes;
}

int SpriteGrid::level_of(float radius_px) const {
    return radius_px <= largest_cells_ ? 0 : int(std::ceil(std::log2(radius_px / largest_cells_) - 1e-4f));
}

SpriteGrid::Place SpriteGrid::place(float x, float y, float coc_px) const {
    const int step = std::min(step_of(std::abs(coc_px)), steps_ - 1);
    Place p;
    p.level = level_of(radius_of(step));
    const float per_cell = 1 / float(1 << p.level);
    const auto phase = [&](float at, int& cell) {
        const int parts =
            int(std::floor((at * per_cell - 0.5f) * float(phases_) + 0.5f - first_phase(p.level)));
        cell = int(std::floor(float(parts) / float(phases_)));
        return parts - cell * phases_;
    };
    const int phase_x = phase(x, p.x), phase_y = phase(y, p.y);
    const auto part = [](float at, int begin, int size, int parts) {
        return std::clamp(int((at - float(begin)) / float(size) * float(parts)), 0, parts - 1);
    };
    const int zone =
        part(y, frame_.y0, frame_.height(), rows_) * columns_ + part(x, frame_.x0, frame_.width(), columns_);
    const int side = coc_px < 0 ? 0 : 1;
    p.kernel = (std::size_t(zone * 2 + side) * std::size_t(steps_) + std::size_t(step)) *
                   std::size_t(phases_ * phases_) +
               std::size_t(phase_y * phases_ + phase_x);
    return p;
}

device::KernelAsk SpriteGrid::ask(std::size_t kernel) const {
    const auto take = [&](int count) {
        const auto digit = int(kernel % std::size_t(count));
        kernel /= std::size_t(count);
        return digit;
    };
    device::KernelAsk ask;
    ask.piece = take(phases_ * phases_);
    const int step = take(steps_);
    ask.level = level_of(radius_of(step));
    ask.step = step + kFarSteps * take(2);
    ask.zone = int(kernel);
    return ask;
}

float SpriteGrid::radius_px(const device::KernelAsk& ask) {
    return (ask.step >= kFarSteps ? 1.0f : -1.0f) * radius_of(ask.step % kFarSteps);
}

float SpriteGrid::reach_px(int level, float coc_px) const {
    if (level > 0) return float(reach_[std::size_t(level)] + 2) * float(1 << level);
    return pixels_per_radius_ * std::abs(coc_px) * 1.02f + 4;
}

SpriteKernels::SpriteKernels(const LensOnPicture& lens, const SpriteGrid& grid, const std::string& light)
    : KernelSource(
          "sprites in " + std::to_string(grid.columns()) + " x " + std::to_string(grid.rows()) + light,
          device::KernelUse::Masked),
      lens_(lens.from(lens.frame.x0, lens.frame.y0)),
      grid_(grid) {}

std::vector<device::KernelSource::Made> SpriteKernels::make(std::span<const device::KernelAsk> asks) const {
    std::vector<Made> made;
    for (const device::KernelAsk& ask : asks) {
        const int column = ask.zone % grid_.columns(), row = ask.zone / grid_.columns();
        const double x = (column + 0.5) * lens_.frame.width() / grid_.columns() - 0.5;
        const double y = (row + 0.5) * lens_.frame.height() / grid_.rows() - 0.5;
        const int phase_x = ask.piece % grid_.phases(), phase_y = ask.piece / grid_.phases();
        const float first = grid_.first_phase(ask.level);
        const float right = (float(phase_x) + first) / float(grid_.phases());
        const float down = (float(phase_y) + first) / float(grid_.phases());
        const double radius_px = double(SpriteGrid::radius_px(ask));
        const double cells = radius_in_cells(radius_px, ask.level, moving_blur(right, down));
        kernel::PointSpread at_cell = lens_.level(ask.level).point_spread(cells, lens_.field_at(x, y));
        made.push_back({std::make_shared<const kernel::PointSpread>(moved(std::move(at_cell), right, down))});
    }
    return made;
}

}  // namespace petzval::engine
