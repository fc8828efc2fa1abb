#include "engine/lights/highlight_kernels.h"

#include "base/cancel.h"
#include "kernel/model/enlarged.h"
#include "kernel/model/radius_on_grid.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kSizes[] = {1, 2, 4, kLargestSquare};
// Radii at which it is seen where in a pixel a lamp lies. Less stays in its pixel; from the latter on, lamps
// are taken as squares.
constexpr float kPartsFromPx = 0.25f, kPartsUpToPx = 8;
// Pixels of a wide disc are not seen if its light is dim: its kernel is made on cells, of which its radius
// has this many to twice as many, and enlarged. To make it costs hardly more, however wide it is.
constexpr float kLeastRadiusCells = 32;
constexpr int kSeens = 3, kMostLevels = 4;
constexpr int kBanks = kSeens + kMostLevels;
int level_of_bank(int bank) { return std::max(0, bank - (kSeens - 1)); }
// Pieces from here on are parts of a pixel.
constexpr int kFirstPart = kBanks * int(std::size(kSizes)),
              kPlaces = PartOfPixel::kMostEighths + 1 + PartOfPixel::kWhole;
int piece_of(PartOfPixel part) {
    return kFirstPart + kPlaces * (part.y + PartOfPixel::kMostEighths) + part.x + PartOfPixel::kMostEighths;
}
PartOfPixel part_of(int piece) {
    const int place = piece - kFirstPart;
    return {place % kPlaces - PartOfPixel::kMostEighths, place / kPlaces - PartOfPixel::kMostEighths};
}

constexpr std::size_t kPointBytes = std::size_t(160) << 20, kSquareBytes = std::size_t(192) << 20;

// The kernel averaged over `size` x `size` places of its source, of which the first is the top-left pixel.
kernel::PointSpread of_square(const kernel::PointSpread& point, int size) {
    const Rect e = point.extent;
    const int width = e.width(), height = e.height(), more = size - 1;
    Picture wide(width + more, height);
    for (int y = 0; y < height; ++y) {
        check_cancelled();
        for (int x = 0; x < width; ++x)
            for (int i = 0; i < size; ++i) wide(x + i, y) += point.weights(x, y);
    }
    Picture square(width + more, height + more);
    const float share = 1 / float(size * size);
    for (int y = 0; y < height; ++y) {
        check_cancelled();
        for (int x = 0; x < width + more; ++x)
            for (int i = 0; i < size; ++i) square(x, y + i) += share * wide(x, y);
    }
    return {Rect{e.x0, e.y0, e.x1 + more, e.y1 + more}, std::move(square), point.neutral};
}

// Steps of radius and place that nobody sees. Those of a kernel as wide as its blur are constants. A lens
// whose halo is wide, which is how far it spreads a point in focus, takes long to draw, and changes as little
// from one of the larger steps to the next. From place to place it is the rim that moves.
kernel::BankOptions steps(const EngineView& input, Seen seen, int level) {
    const Quality quality = input.options.quality;
    const double share = quality == Quality::Draft ? 8 : quality == Quality::Final ? 1 : 2;
    const double halo_px = share * input.lens.level(level).reach_px(0);
    kernel::BankOptions options{.columns = 32,
                                .rows = 18,
                                .aspect = double(input.lens.frame.width()) / input.lens.frame.height(),
                                .max_bytes = kPointBytes};
    const bool disc = seen != Seen::Nothing, rim = seen == Seen::DiscAndRim;
    options.relative_step = disc ? 0.001 : 0.005;
    options.least_step_px = disc ? std::max(0.02, 0.0005 * halo_px) : std::max(0.0625, 0.005 * halo_px);
    // Bright discs: final quality gives each the kernel of its own place.
    options.largest_rim_step_px = rim ? std::max(quality == Quality::Final ? 0.01 : 0.1, 0.002 * halo_px)
                                      : std::max(0.5, 0.02 * halo_px);
    return options;
}

}  // namespace

HighlightKernels::HighlightKernels(const EngineView& input)
    : KernelSource("highlights", device::KernelUse::ByPixel),
      lens_(input.lens),
      knows_parts_(!kernel::blurs_in_focus(lens_.level(0))),
      squares_(kSquareBytes) {
    for (const Seen seen : {Seen::Nothing, Seen::Disc, Seen::DiscAndRim})
        points_.emplace_back(lens_.level(0), steps(input, seen, 0));
    const int levels = lens_.level(0).is_quick() ? 1 : std::min(int(lens_.levels.size()), 1 + kMostLevels);
    for (int level = 1; level < levels; ++level)
        points_.emplace_back(lens_.level(level), steps(input, Seen::Nothing, level));
}

std::size_t HighlightKernels::bank_for(float radius_px, Seen seen) const {
    if (seen != Seen::Nothing) return std::size_t(seen);
    int level = 0;
    while (kSeens + level < int(points_.size()) && std::ldexp(radius_px, -1 - level) >= kLeastRadiusCells)
        ++level;
    return level == 0 ? 0 : std::size_t(kSeens + level - 1);
}

device::KernelAsk HighlightKernels::ask(const Highlight& h, kernel::FieldPosition field, Seen seen) const {
    const float radius = std::abs(h.coc_px);
    if (knows_parts_ && !(h.part == PartOfPixel{}) && radius > kPartsFromPx && radius < kPartsUpToPx) {
        const auto place = points_[std::size_t(Seen::Disc)].place(double(h.coc_px), field);
        device::KernelAsk ask;
        ask.zone = place.cell;
        ask.step = place.step;
        ask.piece = piece_of(h.part);
        return ask;
    }
    int size = 0;
    while (kSizes[size] < h.size) ++size;
    const std::size_t bank = bank_for(radius, seen);
    const double in_cells = std::ldexp(double(h.coc_px), -level_of_bank(int(bank)));
    const kernel::KernelBank::Place place = points_[bank].place(in_cells, field);
    return {.level = 0, .zone = place.cell, .step = place.step, .piece = kBanks * size + int(bank)};
}

std::shared_ptr<const kernel::PointSpread> HighlightKernels::of_point(const device::KernelAsk& ask) const {
    const int bank = ask.piece % kBanks, level = level_of_bank(bank);
    const kernel::KernelBank& points = points_[std::size_t(bank)];
    auto point = points.kernel({ask.step, ask.zone});
    if (level == 0) return point;
    const double radius_px = std::ldexp(points.radius_px({ask.step, ask.zone}), level);
    const int reach_px = int(std::ceil(lens_.level(0).reach_px(radius_px)));
    return std::make_shared<const kernel::PointSpread>(kernel::enlarged(*point, level, reach_px));
}

std::vector<device::KernelSource::Made> HighlightKernels::make(
    std::span<const device::KernelAsk> asks) const {
    std::vector<Made> made;
    for (const device::KernelAsk& ask : asks) {
        if (ask.piece >= kFirstPart) {
            made.push_back({squares_.get(ask, [&] { return of_part(ask); })});
            continue;
        }
        const int size = kSizes[ask.piece / kBanks];
        made.push_back(
            {size == 1 ? of_point(ask) : squares_.get(ask, [&] { return of_square(*of_point(ask), size); })});
    }
    return made;
}

kernel::PointSpread HighlightKernels::of_part(const device::KernelAsk& ask) const {
    const kernel::KernelBank& bank = points_[std::size_t(Seen::Disc)];
    const kernel::KernelBank::Place place{ask.step, ask.zone};
    return spread_of_part(lens_.level(0), bank.radius_px(place), bank.middle(place), part_of(ask.piece));
}

std::size_t HighlightKernels::bytes() const {
    std::size_t bytes = sizeof(*this) + squares_.bytes();
    for (const kernel::KernelBank& bank : points_) bytes += bank.bytes_held();
    return bytes;
}

}  // namespace petzval::engine
