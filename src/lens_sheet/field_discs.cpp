// Discs over the field: cat's eye, coma, swirl.
#include "base/parallel.h"
#include "lens_sheet/figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace petzval::lens_sheet {
namespace {

constexpr int kCell = 108;  // px of the picture
constexpr double kCellCss = 72;
constexpr int kColumns = 7, kRows = 5;

kernel::FieldPosition place_of(int column, int row) {
    const double half_diagonal = std::hypot(1.0, 2.0 / 3);
    const double x = 2 * (column + 0.5) / kColumns - 1, y = 1 - 2 * (row + 0.5) / kRows;
    return {x / half_diagonal, y * 2 / 3 / half_diagonal};
}

// Largest distance of light from the middle of any disc of the frame, in micrometres.
double reach_um(const kernel::GeometricLens& lens, double coc_um) {
    double reach = 0;
    for (const double field : {0.0, 0.3, 0.6, 0.85}) {
        const kernel::FieldPosition place{0, field};
        const auto landing = lens.landing(546.074, coc_um, place);
        for (const Point& p : lens.pupil_outline(place, 1e-2)) {
            const Point at = landing(p), half = landing(0.5 * p);
            reach = std::max({reach, std::abs(at.x), std::abs(at.y), std::abs(half.x), std::abs(half.y)});
        }
    }
    return reach;
}

// The discs of a frame, of a round pupil: the quarter at top left stands for all.
Canvas frame_of(const kernel::LensModel& lens, double coc_px, Workers& workers) {
    constexpr int kQuarterColumns = (kColumns + 1) / 2, kQuarterRows = (kRows + 1) / 2;
    std::vector<kernel::PointSpread> discs(std::size_t(kQuarterColumns * kQuarterRows));
    parallel_for(int(discs.size()), workers, [&](int i) {
        discs[std::size_t(i)] = lens.point_spread(coc_px, place_of(i % kQuarterColumns, i / kQuarterColumns));
    });
    const double gain = even_gain(discs.back());  // the middle's for all
    Canvas canvas(kColumns * kCell, kRows * kCell);
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const int c = std::min(column, kColumns - 1 - column), r = std::min(row, kRows - 1 - row);
            const int x = column * kCell, y = row * kCell;
            canvas.add(discs[std::size_t(r * kQuarterColumns + c)], x + kCell / 2, y + kCell / 2, gain,
                       {x, y, x + kCell, y + kCell}, {column != c, row != r});
        }
    return canvas;
}

// Frames in front of and behind focus, each at a separate scale.
std::optional<Figure> pair_of(const Subject& subject, const std::string& title, const LensChoice& character,
                              double blurs, const std::string& caption) {
    constexpr double kWide = kColumns * kCellCss, kHigh = kRows * kCellCss, kGap = 30, kTop = 26;
    const auto fine = subject.mounted(subject.f_number(), character);
    if (!fine) return std::nullopt;
    Svg svg(2 * kWide + kGap, kHigh + kTop + 2, title);
    for (const int side : {-1, 1}) {
        const double coc_um = side * blurs * subject.blur_um(), x = side < 0 ? 0 : kWide + kGap;
        const double um_per_px = reach_um(**fine, coc_um) / (0.46 * kCell);
        const auto coarse = subject.mounted(subject.f_number(), character, um_per_px);
        if (!coarse) return std::nullopt;
        svg.text({x, kTop - 9}, title + (side < 0 ? ", in front of focus" : ", behind"), "title");
        svg.text({x + kWide, kTop - 9}, "cell " + significant(um_per_px * kCell, 2) + " µm", "tick",
                 Anchor::End);
        svg.image({x, kTop}, kWide, kHigh, frame_of(**coarse, coc_um / um_per_px, subject.workers()).uri());
    }
    return Figure{svg.str(),
                  caption + " Circle of confusion: ±" + significant(blurs * subject.blur_um(), 2) +
                      " µm radius; the frame reaches " + significant(subject.corner_deg(), 2) +
                      "° at its corners.",
                  12};
}

std::vector<Figure> traced_fields(const Subject& subject) {
    std::vector<Figure> figures;
    if (auto large = pair_of(subject, "Large discs", {}, 8,
                             "Far from focus, the outline of a disc shows most. The rims of the barrel cut "
                             "it to a lemon, on opposite sides in front of focus and behind."))
        figures.push_back(std::move(*large));
    if (auto small = pair_of(subject, "Small discs", {}, 2,
                             "Near focus, the aberrations of the field show most. Coma makes one edge of a "
                             "disc bright. Astigmatism stretches discs along circles on one side of focus "
                             "and along radii on the other, so the blur swirls."))
        figures.push_back(std::move(*small));
    return figures;
}

double one_digit(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    return std::round(value / power) * power;
}

std::vector<Figure> drawn_fields(const Subject& subject) {
    constexpr double kBlurs = 3;
    LensChoice barrel, coma, astigmatism, curvature, colour;
    barrel.cats_eye = 0.8, coma.coma = 1, astigmatism.astigmatism = 2;
    // Size at the corner: the disc's own radius, and a fifth of it for each colour.
    const double corner_um =
        1000 * subject.focal_length_mm() * std::tan(subject.corner_deg() * std::numbers::pi / 180);
    const double radius_um = kBlurs * subject.blur_um();
    curvature.added.field_curvature_mm = -one_digit(2 * subject.f_number() * radius_um / 1000);
    colour.added.lateral_colour_percent = one_digit(100 * 0.4 * radius_um / corner_um);
    const std::string curved = "--add-field-curvature " + number(curvature.added.field_curvature_mm, 3);
    const std::string coloured = "--add-lateral-colour " + number(colour.added.lateral_colour_percent, 3);
    const struct {
        const char* title;
        const char* words;
        const LensChoice* character;
    } settings[] = {
        {"--cats-eye 0.8",
         "The barrel cuts discs by a second circle, which is as wide as the pupil and shifted towards the "
         "corner.",
         &barrel},
        {"--coma 1",
         "Coma: outer zones of the pupil form larger images. One edge of a disc stays bright; the side of "
         "the tail fades.",
         &coma},
        {"--astigmatism 2",
         "Astigmatism: lines in two directions have two foci. Discs are stretched around the middle of the "
         "frame on one side of focus, and towards it on the other.",
         &astigmatism},
        {curved.c_str(),
         "Field curvature: the corners focus nearer to the lens, as in all simple lenses. There, lights "
         "behind focus have larger discs; lights in front have smaller ones, or are behind the curved focus.",
         &curvature},
        {coloured.c_str(),
         "Lateral colour: the blue image is larger than the red one. Discs have a blue outer edge and a red "
         "inner edge, on both sides of focus.",
         &colour}};
    std::vector<Figure> figures{coma_principle(subject)};
    for (const auto& setting : settings)
        if (auto figure = pair_of(subject, setting.title, *setting.character, kBlurs, setting.words))
            figures.push_back(std::move(*figure));
    return figures;
}

}  // namespace

std::vector<Figure> field_discs(const Subject& subject) {
    return subject.prescription() ? traced_fields(subject) : drawn_fields(subject);
}

}  // namespace petzval::lens_sheet
