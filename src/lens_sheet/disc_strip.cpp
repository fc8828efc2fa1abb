// Discs from far in front of focus to far behind, at three f-numbers.
#include "base/parallel.h"
#include "lens_sheet/figures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::lens_sheet {
namespace {

// Defocus of the columns, in Subject::blur_um wide open.
constexpr std::array<double, 11> kColumns{-12, -5, -2.5, -1.2, -0.5, 0, 0.5, 1.2, 2.5, 5, 12};
constexpr int kCell = 144;  // px of the picture
constexpr double kCellCss = 92, kLeft = 62, kTop = 26;

struct Cell {
    std::size_t column = 0, row = 0;
    kernel::PointSpread disc;
};

// Micrometres per pixel of a column: the open disc fills the cell.
double zoom_of(const Subject& subject, double blurs) {
    return subject.axis().reach_um(blurs * subject.blur_um()) / (0.45 * kCell) + 1e-6;
}

std::string caption(const Subject& subject) {
    return "Discs of a point of light, from far in front of focus (left) to far behind (right). All discs of "
           "a column have one scale, at which the disc wide open fills its cell; the number below is the "
           "radius of its circle of confusion. Stopped down, discs become smaller and also flatter, because "
           "spherical aberration falls with the cube of the aperture. All discs are drawn equally bright; "
           "the real light per area falls with the square of the radius. <code>petzval lens psf " +
           escaped(subject.asked()) + " --defocus 40 -o disc.exr</code>";
}

// A thin line through the source, upright: the disc's columns, each as bright as all of it together.
void add_line(Canvas& canvas, const kernel::PointSpread& disc, int x0) {
    std::vector<Rgba> columns(std::size_t(kCell), Rgba{});
    float most = 1e-12f;
    for (int u = disc.extent.x0; u < disc.extent.x1; ++u) {
        const int x = kCell / 2 + u;
        if (x < 1 || x >= kCell - 1) continue;
        Rgba& sum = columns[std::size_t(x)];
        for (int v = 0; v < disc.weights.height(); ++v) sum += disc.weights(u - disc.extent.x0, v);
        most = std::max({most, sum.r, sum.g, sum.b});
    }
    for (int y = 0; y < canvas.light().height(); ++y)
        for (int x = 0; x < kCell; ++x) canvas.light()(x0 + x, y) = (0.8f / most) * columns[std::size_t(x)];
}

}  // namespace

std::string disc_pair(const Subject& subject, int disc_px) {
    constexpr double kCss = 104, kBlurs = 2.2;
    Canvas canvas(2 * disc_px, disc_px);
    for (const int side : {-1, 1}) {
        const double coc = side * kBlurs * subject.blur_um();
        const auto disc = subject.axis().disc(coc, subject.axis().reach_um(coc) / (0.44 * disc_px));
        const int x = side < 0 ? 0 : disc_px;
        canvas.add(disc, x + disc_px / 2, disc_px / 2, even_gain(disc), {x, 0, x + disc_px, disc_px});
    }
    Svg svg(2 * kCss, kCss, "discs of " + subject.name() + " in front of focus and behind");
    return svg.image({0, 0}, 2 * kCss, kCss, canvas.uri()).str();
}

Figure line_strip(const Subject& subject) {
    constexpr int kHigh = 60;
    constexpr double kHighCss = kHigh * kCellCss / kCell;
    const int columns = int(kColumns.size());
    Canvas canvas(columns * kCell, kHigh);
    for (int i = 0; i < columns; ++i) {
        const double blurs = kColumns[std::size_t(i)];
        add_line(canvas, subject.axis().disc(blurs * subject.blur_um(), zoom_of(subject, blurs)), i * kCell);
    }
    Svg svg(kLeft + columns * kCellCss + 4, kHighCss + 8, "a thin line through " + subject.name());
    svg.image({kLeft, 4}, columns * kCellCss, kHighCss, canvas.uri());
    svg.text({kLeft - 8, 4 + kHighCss / 2 + 4}, "a line", "name", Anchor::End);
    return {svg.str(),
            "A thin bright line, such as a twig, a wire or a blade of grass, wide open and in the same "
            "columns. If discs have a bright rim, the line splits in two; if they also have a bright core, "
            "in three. Photographers call this two-line or three-line bokeh.",
            12};
}

Figure disc_strip(const Subject& subject) {
    std::vector<double> f_numbers;
    std::vector<Axial> lenses;
    for (const double stops : {0.0, 1.0, 2.0}) {
        const double n = subject.f_number() * std::pow(2, stops / 2);
        if (const auto lens = subject.mounted(n)) f_numbers.push_back(n), lenses.emplace_back(*lens);
    }
    std::vector<Cell> cells;
    for (std::size_t row = 0; row < lenses.size(); ++row)
        for (std::size_t column = 0; column < kColumns.size(); ++column) cells.push_back({column, row, {}});
    parallel_for(int(cells.size()), subject.workers(), [&](int i) {
        Cell& cell = cells[std::size_t(i)];
        const double blurs = kColumns[cell.column], smaller = subject.f_number() / f_numbers[cell.row];
        cell.disc = lenses[cell.row].disc(blurs * subject.blur_um() * smaller, zoom_of(subject, blurs));
    });

    const int columns = int(kColumns.size()), rows = int(lenses.size());
    Canvas canvas(columns * kCell, rows * kCell);
    for (const Cell& cell : cells) {
        const int x = int(cell.column) * kCell, y = int(cell.row) * kCell;
        canvas.add(cell.disc, x + kCell / 2, y + kCell / 2, even_gain(cell.disc),
                   {x + 1, y + 1, x + kCell - 1, y + kCell - 1});
    }
    Svg svg(kLeft + columns * kCellCss + 4, kTop + rows * kCellCss + 44, "discs of " + subject.name());
    svg.image({kLeft, kTop}, columns * kCellCss, rows * kCellCss, canvas.uri());
    for (int row = 0; row < rows; ++row)
        svg.text({kLeft - 8, kTop + (row + 0.5) * kCellCss + 4},
                 "f/" + significant(f_numbers[std::size_t(row)], 2), "name", Anchor::End);
    const double bottom = kTop + rows * kCellCss;
    for (int i = 0; i < columns; ++i) {
        const double um = kColumns[std::size_t(i)] * subject.blur_um(), x = kLeft + (i + 0.5) * kCellCss;
        svg.text({x, bottom + 15}, (um > 0 ? "+" : "") + significant(um, 2) + " µm", "tick", Anchor::Middle);
        svg.text({x, bottom + 30},
                 "cell " + significant(zoom_of(subject, kColumns[std::size_t(i)]) * kCell, 2) + " µm", "tick",
                 Anchor::Middle);
    }
    svg.text({kLeft, kTop - 9}, "← far in front of focus", "title");
    svg.text({kLeft + columns * kCellCss / 2, kTop - 9}, "in focus", "title", Anchor::Middle);
    svg.text({kLeft + columns * kCellCss, kTop - 9}, "far behind →", "title", Anchor::End);
    return {svg.str(), caption(subject), 12};
}

}  // namespace petzval::lens_sheet
