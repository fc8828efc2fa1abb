// Input of the real-time pass (docs/explain/real-time.md): a lens's shape in front of focus and
// behind it, as a device's programs read it, and a picture.
#pragma once

#include "petzval/engine_options.h"
#include "petzval/image.h"

#include "kernel/model/lens_model.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

namespace petzval::engine {

// Kernels of lamps: of kSteps radii, each sqrt(2) times as large as the one before. First come their heads,
// those in front of focus and then those behind it: index of the kernel's first four, cells from the middle
// to the rim of its square, radius in cells, and the squared distance from the middle from which on no place
// between cells has light (in any zone). Then come the weights of all kernels; those of one kernel sum to 1,
// and cells outside the largest circle of the square have none. A cell is a pixel, or half of one up to
// kFinePx, because interpolation between whole pixels would soften the rims of small discs.
struct LampKernels {
    static constexpr int kSteps = 14;
    static constexpr double kFirstPx = 0.5, kHalf = 1.25;  // pixels; radii that a square is half as wide as
    static constexpr double kFinePx = 8.1;
    static constexpr int cells_per_px(double radius_px) { return radius_px < kFinePx ? 2 : 1; }
    // Half the side of a kernel's square in cells: the whole shape and an empty rim.
    static constexpr int half_side(double radius_px) {
        return int(kHalf * radius_px * cells_per_px(radius_px)) + 2 * cells_per_px(radius_px);
    }
    static constexpr std::size_t weights() {
        std::size_t sum = 0;
        double radius_px = kFirstPx;
        for (int i = 0; i < kSteps; ++i, radius_px *= std::numbers::sqrt2) {
            const auto side = std::size_t(2 * half_side(radius_px) + 1);
            sum += side * side;
        }
        return sum;
    }
};

// Places of the field whose kernels a pass has: a grid over the frame, row by row from the top left, whose
// outermost nodes lie on the frame's sides. Kernels between nodes are interpolated.
struct RealtimeZones {
    std::uint32_t columns = 1, rows = 1;
    double half_width = 0, half_height = 0;  // of the frame, as FieldPosition counts

    std::uint32_t count() const { return columns * rows; }
    kernel::FieldPosition at(std::uint32_t zone) const;
};
// One zone if the lens is the same over the field, otherwise 45. width, height: of the frame, in widths of a
// pixel.
RealtimeZones realtime_zones(const kernel::LensModel& lens, double width, double height);

// The lens as fours of floats. The first four is a head: number of taps, side of the squares that they read
// on a disc of radius 1, columns and rows of zones. Taps over that disc follow (x, y, distance from the
// middle, weight near it): kSpirals of them, one for each of the four cells of a square, because
// their taps together are as good as four times as many. Then come kGridTaps whole cells, nearest first, for
// discs up to a radius in cells: that of its disc, which is the fourth number of its last tap. The fourth
// number of tap i is how many of them a disc up to (i + 1) / 8 cells takes. Then each zone has the weights of
// its taps, kShares for each tap of each set, for light blurred by 0 to 1 of the disc's radius, in front of
// focus and then behind it. A weight has r, g, b and a, and each of these sums to 1 over the taps. The
// LampKernels of a zone come last.
struct RealtimeLens {
    static constexpr int kMostTaps = 127, kSpirals = 4, kGridTaps = 72, kShares = 64;
    static constexpr std::size_t kOfLamps = 2 * (LampKernels::kSteps + LampKernels::weights());
    static_assert(kOfLamps == 67800, "as shaders/realtime.glsl has it");
    // Names this layout: change its last letter with the place or the meaning of any number. The mark is
    // stored as the x of the first tap. That tap lies in the middle, and the mark read as a number is 1e-8.
    static constexpr std::array<char, 4> kMark{'P', 'Z', 'L', '2'};
    static constexpr std::size_t kMarkByte = sizeof(Rgba);
    std::vector<Rgba> fours;
    int taps() const { return int(fours[0].r); }
    static constexpr std::size_t all_taps(int taps) { return std::size_t(kSpirals * taps + kGridTaps); }
    static constexpr std::size_t of_zone(int taps) { return all_taps(taps) * 2 * kShares + kOfLamps; }
    // Number of fours of a lens.
    static constexpr std::size_t count(int taps, std::uint32_t zones) {
        return 1 + all_taps(taps) + zones * of_zone(taps);
    }
    std::size_t first_zone() const { return 1 + all_taps(taps()); }  // where weights begin
    std::size_t bytes() const { return fours.size() * sizeof(Rgba); }
};

// Number of taps of a quality: 24, 48 or 127.
int realtime_taps(Quality quality);
// The shapes that a lens has at these radii, in pixels, in each zone. Requires: 1 to kMostTaps taps.
RealtimeLens realtime_lens(const kernel::LensModel& lens, const RealtimeZones& zones, double near_radius_px,
                           double far_radius_px, int taps);

// The lens as hosts draw it on a frame of this size: its shapes are those of discs of 45 px, the largest that
// lamps have.
RealtimeLens realtime_lens_of_host(const kernel::LensModel& lens, double width, double height,
                                   Quality quality);

struct RealtimePlan {
    View<const Rgba> colour;
    View<const float> coc_px;
    float most_px = 0;  // no radius is larger
    float pixel_aspect = 1;
    std::shared_ptr<const RealtimeLens> lens;
    Rect frame = {};  // that its zones span, in pixels of the picture; empty: the picture
};

}  // namespace petzval::engine
