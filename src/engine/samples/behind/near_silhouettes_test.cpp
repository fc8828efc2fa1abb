#include "engine/samples/behind/near_silhouettes.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/behind/search.h"
#include "engine/samples/silhouettes/connectivity.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSide = 96;
constexpr float kNearestPx = -9, kFarthestPx = 6;

// Discs of all depths on a wall.
Plane discs(unsigned seed) {
    std::mt19937 random(seed);
    const auto any = [&](float from, float to) {
        return std::uniform_real_distribution<float>(from, to)(random);
    };
    Plane coc(kSide, kSide, kFarthestPx);
    for (int i = 0; i < 12; ++i) {
        const float x = any(0, kSide), y = any(0, kSide), r = any(2, 20), px = any(kNearestPx, kFarthestPx);
        for (int v = 0; v < kSide; ++v)
            for (int u = 0; u < kSide; ++u)
                if (std::hypot(float(u) - x, float(v) - y) < r) coc(u, v) = std::min(coc(u, v), px);
    }
    return coc;
}

TEST(NearSilhouettes, MissNoPixelWhereASearchFindsASurface) {
    int found = 0, refused = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Plane coc = discs(seed);
        const Picture colour(kSide, kSide, {0.5f, 0.5f, 0.5f, 1});
        const LitPicture picture{colour, {}};
        const auto connected = connections(coc, one_thread());
        const Mixtures mixtures = unmix_silhouettes(picture, coc, connected, one_thread());
        const KnownSurfaces known(picture, coc, mixtures, 0, one_thread());
        const SurfaceSearch search(known, coc, connected, mixtures, -kNearestPx, kFarthestPx, one_thread());
        const NearSilhouettes near(coc, mixtures, one_thread());
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                if (mixtures.at(x, y)) continue;
                bool reached = false;
                for (std::size_t k = 0; k < kDirections; ++k)
                    for (const Found& f : search.look({x, y, coc(x, y), {}, 0}, k))
                        reached |= f.found && f.distance_px <= SurfaceSearch::reach_px(coc(x, y), f.coc_px);
                const bool may_hide = near.may_hide(x, y, coc(x, y));
                EXPECT_TRUE(may_hide || !reached) << seed << ": " << x << ", " << y;
                found += reached, refused += !may_hide;
            }
    }
    EXPECT_GT(found, 4000);
    EXPECT_GT(refused, 4000);
}

}  // namespace
}  // namespace petzval::engine
