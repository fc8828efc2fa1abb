// Carries something from each cell of a grid to all cells that it reaches, in two sweeps.
#pragma once

namespace petzval {

// Calls relax(x, y, dx, dy) for every cell (x, y) and its neighbour (x + dx, y + dy) on the grid: with the
// four neighbours above and to the left row by row, then with the other four from the end. Distances found so
// are chamfer distances (G. Borgefors, "Distance transformations in digital images", 1986).
template <typename Relax>
void two_sweeps(int width, int height, const Relax& relax) {
    const auto with = [&](int x, int y, int dx, int dy) {
        if (x + dx >= 0 && x + dx < width && y + dy >= 0 && y + dy < height) relax(x, y, dx, dy);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            with(x, y, -1, 0), with(x, y, -1, -1), with(x, y, 0, -1), with(x, y, 1, -1);
    for (int y = height - 1; y >= 0; --y)
        for (int x = width - 1; x >= 0; --x)
            with(x, y, 1, 0), with(x, y, 1, 1), with(x, y, 0, 1), with(x, y, -1, 1);
}

// Distance to a neighbour, in cells, by which two sweeps come closest to Euclid's.
constexpr float chamfer_step(int dx, int dy) { return dx != 0 && dy != 0 ? 1.3693f : 0.955f; }

}  // namespace petzval
