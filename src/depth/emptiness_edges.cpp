#include "depth/emptiness_edges.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace petzval {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr int kFilter = 4, kInside = 3;  // px: mixed pixels beside emptiness; pixels inside of one
constexpr float kDip = 0.9f;             // of the depth inside

struct Towards {
    int dx, dy;
};
constexpr std::array<Towards, 8> kAllWays{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

class Outlines {
public:
    explicit Outlines(View<const float> depth_m) : depth_m_(depth_m) {}

    bool is_empty(int x, int y) const { return depth_m_.rect().contains(x, y) && is_nothing(depth_m_(x, y)); }
    // Distance to the emptiness in the direction opposite to `inside`; beyond a filter's reach: kFilter + 1.
    int distance_px(int x, int y, Towards inside) const {
        int i = 1;
        while (i <= kFilter && !is_empty(x - i * inside.dx, y - i * inside.dy)) ++i;
        return i;
    }
    // Depth of the surface whose edge (x, y) is: the farthest of the pixels inside. 0: it is no wider than
    // the filter.
    float surface_m(int x, int y, Towards inside) const {
        float farthest = 0;
        for (int i = 1; i <= kInside; ++i) {
            const int u = x + i * inside.dx, v = y + i * inside.dy;
            if (!depth_m_.rect().contains(u, v) || is_nothing(depth_m_(u, v))) return 0;
            farthest = std::max(farthest, depth_m_(u, v));
        }
        return farthest;
    }
    // The same by the direction in which the emptiness is closest. 0: none is close by.
    float surface_m(int x, int y) const {
        float found = 0;
        int closest = kFilter;
        for (const Towards inside : kAllWays) {
            const int distance = distance_px(x, y, inside);
            const float z = distance <= closest ? surface_m(x, y, inside) : 0;
            if (z <= 0) continue;
            found = distance < closest ? z : std::max(found, z);
            closest = distance;
        }
        return found;
    }

private:
    static bool is_nothing(float z) { return !(z > 0 && z < kNothing); }

    View<const float> depth_m_;
};

}  // namespace

bool dips_before_emptiness(View<const float> depth_m, Workers& workers) {
    constexpr int kFew = 256;  // ends; thumbnails have slits of sky
    constexpr float kMost = 0.5f;
    const Outlines outlines(depth_m);
    struct Count {
        int ends = 0, dips = 0;
    };
    std::vector<Count> rows(std::size_t(depth_m.height()));
    parallel_for(depth_m.height(), workers, [&](int y) {
        for (int x = 0; x < depth_m.width(); ++x) {
            if (outlines.is_empty(x, y)) continue;
            for (const Towards inside : {kAllWays[0], kAllWays[1], kAllWays[2], kAllWays[3]}) {
                if (!outlines.is_empty(x - inside.dx, y - inside.dy)) continue;
                const float surface_m = outlines.surface_m(x, y, inside);
                if (surface_m <= 0) continue;
                Count& row = rows[std::size_t(y)];
                ++row.ends;
                row.dips += depth_m(x, y) < kDip * surface_m;
            }
        }
    });
    Count all;
    for (const Count& row : rows) {
        all.ends += row.ends;
        all.dips += row.dips;
    }
    return all.ends >= kFew && float(all.dips) > kMost * float(all.ends);
}

Plane without_dips(View<const float> depth_m, Workers& workers) {
    constexpr float kWhole = 0.97f, kHalf = 0.5f;
    const Outlines outlines(depth_m);
    Plane out = Plane::uninitialised(depth_m.width(), depth_m.height());
    parallel_for(out.height(), workers, [&](int y) {
        for (int x = 0; x < out.width(); ++x) {
            out(x, y) = depth_m(x, y);
            if (outlines.is_empty(x, y)) continue;
            const float surface_m = outlines.surface_m(x, y), share = depth_m(x, y) / surface_m;
            if (surface_m > 0 && share < kWhole) out(x, y) = share > kHalf ? surface_m : kNothing;
        }
    });
    return out;
}

}  // namespace petzval
