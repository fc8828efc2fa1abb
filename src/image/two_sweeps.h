// Carries something from each cell of a grid to all cells that it reaches, in two sweeps.
#pragma once

namespace petzval {

// Calls relax(x, y, dx, dy) for every cell (x, y) and its neighbour (x + dx, y + dy) on the grid: with the
// four neighbours above and to the left row by row, then with the other four from the end. Distances found so
// are chamfer distances (G. Borgefors, "Distance transformations in digital images", 1986).
template <typename Relax>
void two_sweeps(int width, int height, const Relax& relax) {
    // The neighbour behind (x, y) in the order of a sweep of sense 1 or -1, and the three of the row before.
    const auto with = [&](int x, int y, int sense, bool first_row) {
        const bool behind = sense > 0 ? x > 0 : x + 1 < width, ahead = sense > 0 ? x + 1 < width : x > 0;
        if (behind) relax(x, y, -sense, 0);
        if (first_row) return;
        if (behind) relax(x, y, -sense, -sense);
        relax(x, y, 0, -sense);
        if (ahead) relax(x, y, sense, -sense);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) with(x, y, 1, y == 0);
    for (int y = height - 1; y >= 0; --y)
        for (int x = width - 1; x >= 0; --x) with(x, y, -1, y == height - 1);
}

// Distance to a neighbour, in cells, by which two sweeps come closest to Euclid's.
constexpr float chamfer_step(int dx, int dy) { return dx != 0 && dy != 0 ? 1.3693f : 0.955f; }

}  // namespace petzval
