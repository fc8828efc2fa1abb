#include "kernel/draw/halo.h"

#include "kernel/draw/mesh_kernel.h"
#include "kernel/model/pieces.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

// Spherical aberration that lands the rim of the pupil about size_px away, by colour, of a source blurred by
// coc_px.
std::vector<MeshBand> bands(double size_px, double coc_px, double cell_px) {
    std::vector<MeshBand> colours;
    for (const double share : {0.92, 0.94, 0.96, 0.98, 1.0})
        colours.push_back({{1, 1, 1}, [=](std::span<const Point> points, Point* landed) {
                               for (const Point& p : points) {
                                   const double square = p.x * p.x + p.y * p.y;
                                   const double reach = coc_px + (share * size_px - coc_px) * square;
                                   *landed++ = (reach / cell_px) * p;
                               }
                           }});
    return colours;
}

MeshPupil pupil(double size_px) {
    MeshPupil mesh{{}, {}, mesh_rings(size_px), {}};
    for (int k = 0; k < 400; ++k)
        mesh.outline.push_back(
            {std::cos(2 * std::numbers::pi * k / 400), std::sin(2 * std::numbers::pi * k / 400)});
    return mesh;
}

TEST(Halo, SmallKernelsHaveNoCells) {
    EXPECT_EQ(halo_cell_px(127), 1);
    EXPECT_EQ(halo_cell_px(128), 4);
    EXPECT_EQ(halo_cell_px(256), 8);
}

TEST(Halo, CellsContinueTheCoreAsIfAllWereDrawnInPixels) {
    constexpr double kSize = 200;
    const int cell = halo_cell_px(kSize);
    ASSERT_EQ(cell, 4);
    const PointSpread cells = mesh_kernel(pupil(kSize), bands(kSize, 10, cell));
    const int radius = structure_px(cells, cell);
    EXPECT_GT(radius, 10);
    EXPECT_LT(radius, 0.7 * kSize);
    const Rect window{-radius, -radius, radius + 1, radius + 1};
    const PointSpread core = mesh_kernel(pupil(kSize), bands(kSize, 10, 1), window);
    const PointSpread whole = mesh_kernel(pupil(kSize), bands(kSize, 10, 1));
    const PointSpread joined = with_halo(core, cells, cell, radius, kSize);
    EXPECT_NEAR(sum_of(joined).g, 1, 1e-5);
    EXPECT_LE(joined.extent.x1, cells.extent.x1 * cell);  // no weight is read from beside the cells
    const float even_disc = float(1 / (std::numbers::pi * kSize * kSize));
    constexpr int kRim = 176;  // which is as soft as a cell
    for (int y = -kRim; y <= kRim; ++y)
        for (int x = -kRim; x <= kRim; ++x) {
            const double distance = std::hypot(x, y);
            if (distance > kRim) continue;
            const float exact = whole.weights(x - whole.extent.x0, y - whole.extent.y0).g;
            const float here = joined.weights(x - joined.extent.x0, y - joined.extent.y0).g;
            if (distance < radius - cell)
                ASSERT_NEAR(here, exact, 1e-3f * (exact + even_disc)) << x << " " << y;
            else
                ASSERT_NEAR(here, exact, 0.02f * exact) << x << " " << y;
        }
}

TEST(Halo, BrightRimsAreStructure) {
    // An even disc: only its rim is visible.
    const std::vector<MeshBand> disc = {{{1, 1, 1}, [](std::span<const Point> points, Point* landed) {
                                             for (const Point& p : points) *landed++ = 50.0 * p;
                                         }}};
    EXPECT_GE(structure_px(mesh_kernel(pupil(200), disc), 4), 200);
}

TEST(Halo, AWindowHoldsItsPartOfTheWholeKernel) {
    const PointSpread whole = mesh_kernel(pupil(60), bands(60, -8, 1));
    const Rect window{-20, -7, 15, 30};
    const PointSpread part = mesh_kernel(pupil(60), bands(60, -8, 1), window);
    ASSERT_EQ(part.extent, window);
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x)
            ASSERT_NEAR(part.weights(x - window.x0, y - window.y0).g,
                        whole.weights(x - whole.extent.x0, y - whole.extent.y0).g, 1e-8);
}

TEST(Halo, AWindowBesideTheKernelHoldsNothing) {
    EXPECT_TRUE(mesh_kernel(pupil(60), bands(60, 0, 1), {100, 100, 120, 120}).extent.empty());
}

}  // namespace
}  // namespace petzval::kernel
