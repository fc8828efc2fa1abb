#include "engine/samples/behind/likeness.h"

#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"

#include <array>

namespace petzval::engine {
namespace {

float square(Rgba c) { return c.r * c.r + c.g * c.g + c.b * c.b; }

// A few pixels around the end of a search, as seen coming from the hidden pixel: itself, one to either side,
// two beyond.
constexpr int kPatch = 5;
using Patch = std::array<Rgba, kPatch>;

Patch patch_at(const KnownSurfaces& known, const Found& hit, Direction d) {
    const float near = completion_model.patch_near_px, far = 2 * near;
    const int x = hit.x, y = hit.y;
    // Across the direction in a fixed sense, so that patches met in opposite directions can be compared.
    const bool turned = d.y < 0 || (d.y == 0 && d.x < 0);
    const float across_x = turned ? d.y : -d.y, across_y = turned ? -d.x : d.x;
    const std::array<Direction, kPatch> offsets{{{0, 0},
                                                 {near * across_x, near * across_y},
                                                 {-near * across_x, -near * across_y},
                                                 {near * d.x, near * d.y},
                                                 {far * d.x, far * d.y}}};
    Patch patch;
    for (int k = 0; k < kPatch; ++k) {
        const Direction o = offsets[std::size_t(k)];
        const int u = x + nearest_pixel(o.x), v = y + nearest_pixel(o.y);
        const bool usable = known.shows(u, v, hit.coc_px);
        patch[std::size_t(k)] = comparable(usable ? known.colour(u, v) : known.colour(x, y));
    }
    return patch;
}

}  // namespace

float likeness(const KnownSurfaces& known, const Found& a, Direction to_a, const Found& b, Direction to_b) {
    const Patch at_a = patch_at(known, a, to_a), at_b = patch_at(known, b, to_b);
    const CompletionModel& model = completion_model;
    float difference = 0, level = 1e-16f;  // two black patches are alike
    for (std::size_t k = 0; k < kPatch; ++k) {
        difference += square(at_a[k] - at_b[k]);
        level += square(0.5f * (at_a[k] + at_b[k]));
    }
    const float unlike = difference / level;
    const auto across = [](const Patch& p) { return square(p[0] - p[1]) + square(p[0] - p[2]); };
    const auto along = [](const Patch& p) { return square(p[0] - p[3]) + square(p[0] - p[4]); };
    const float plain = model.patch_alike * level;
    const float edge = (plain + across(at_a) + across(at_b)) / (plain + along(at_a) + along(at_b));
    return edge / (model.patch_alike + unlike * unlike);
}

}  // namespace petzval::engine
