#include "engine/samples/behind/one_surface.h"

#include "engine/samples/completion_model.h"

#include <array>
#include <cmath>
#include <utility>

namespace petzval::engine {

bool on_one_plane(const Found& a, const Found& b) {
    const float x = float(b.x - a.x), y = float(b.y - a.y), step = b.coc_px - a.coc_px;
    const float most = completion_model.step_px;
    return std::abs(a.slope.x * x + a.slope.y * y - step) < most &&
           std::abs(b.slope.x * x + b.slope.y * y - step) < most;
}

bool mark_farthest_surface(Hits& hits) {
    std::array<Found*, std::size_t(kDirections) * kHits> found;  // those on the surface come first
    std::size_t count = 0, marked = 1;
    for (auto& direction : hits)
        for (Found& f : direction) {
            f.on_surface = false;
            if (f.found) found[count++] = &f;
        }
    if (count == 0) return false;
    for (std::size_t i = 1; i < count; ++i)
        if (found[i]->coc_px > found[0]->coc_px) std::swap(found[0], found[i]);
    for (std::size_t i = 0; i < marked; ++i) {
        found[i]->on_surface = true;
        for (std::size_t k = marked; k < count; ++k)
            if (on_one_plane(*found[i], *found[k])) std::swap(found[marked++], found[k]);
    }
    return true;
}

}  // namespace petzval::engine
