#include "files/exr_write/paint.h"

#include "base/parallel.h"
#include "files/exr_write/output.h"
#include "files/half_bits.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace petzval {
namespace {

float component_of(Rgba c, int component) {
    return component == 0 ? c.r : component == 1 ? c.g : component == 2 ? c.b : c.a;
}

}  // namespace

void Painter::fill(BandChannel& to, const Painted& from, int first, int y0, int y1) {
    parallel_for(y1 - y0, workers_, [&](int row) {
        const Rgba* pixels = from.picture->row(y0 + row - first);
        const int width = from.picture->width();
        if (to.channel.type == ChannelType::Half) {
            std::vector<float> values(std::size_t(width), 0.0f);
            fill_row(values.data(), pixels, from, kLargestHalf);
            auto* const halves = reinterpret_cast<std::uint16_t*>(to.row(row));
            for (int x = 0; x < width; ++x) halves[x] = half_bits(values[std::size_t(x)]);
        } else {
            fill_row(reinterpret_cast<float*>(to.row(row)), pixels, from, std::numeric_limits<float>::max());
        }
    });
}

void Painter::fill_row(float* to, const Rgba* from, const Painted& how, float largest) {
    WriteReport row;
    for (int x = 0; x < how.picture->width(); ++x) {
        const Rgba c = how.primaries ? transformed(how.primaries->from_rec709, from[x]) : from[x];
        to[x] = storable(component_of(c, how.component), largest, row);
    }
    if (row.clamped_to_half) clamped_ += row.clamped_to_half;
    if (row.non_finite) non_finite_ += row.non_finite;
}

}  // namespace petzval
