// Effect of the defocus-control ring on this lens.
#include "base/parallel.h"
#include "lens_sheet/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace petzval::lens_sheet {
namespace {

constexpr int kCell = 132;  // px of the picture
constexpr double kCellCss = 110, kLeft = 78, kTop = 26, kBlurs = 4;
constexpr std::array<double, 3> kTurns{-1, 0, 1};

// Waves that throw the rim by twice the lens's own blur: 8 N W (kernel/lenses/third_order.h), to one digit.
double waves_of(const Subject& subject) {
    const double waves = 2 * subject.blur_um() / (8 * subject.f_number() * 0.58756);
    const double power = std::pow(10.0, std::floor(std::log10(waves)));
    return std::max(1.0, std::round(waves / power)) * power;
}

}  // namespace

std::optional<Figure> control_ring(const Subject& subject) {
    const double waves = waves_of(subject);
    std::vector<Axial> lenses;
    for (const double turn : kTurns) {
        LensChoice turned;
        turned.added.spherical_waves = turn * waves;
        const auto lens =
            turn == 0 ? Result<RayLens>(subject.open()) : subject.mounted(subject.f_number(), turned);
        if (!lens) return std::nullopt;
        lenses.emplace_back(*lens);
    }
    const int columns = int(kTurns.size());
    std::array<kernel::PointSpread, 2 * kTurns.size()> discs;
    const auto coc_of = [&](int i) { return (i < columns ? -1 : 1) * kBlurs * subject.blur_um(); };
    double reach = 0;
    for (int i = 0; i < 2 * columns; ++i)
        reach = std::max(reach, lenses[std::size_t(i % columns)].reach_um(coc_of(i)));
    const double um_per_px = reach / (0.46 * kCell);
    parallel_for(int(discs.size()), subject.workers(), [&](int i) {
        discs[std::size_t(i)] = lenses[std::size_t(i % columns)].disc(coc_of(i), um_per_px);
    });
    Canvas canvas(columns * kCell, 2 * kCell);
    for (int i = 0; i < 2 * columns; ++i) {
        const int x = i % columns * kCell, y = i / columns * kCell;
        canvas.add(discs[std::size_t(i)], x + kCell / 2, y + kCell / 2, even_gain(discs[std::size_t(i)]),
                   {x + 1, y + 1, x + kCell - 1, y + kCell - 1});
    }
    Svg svg(kLeft + columns * kCellCss + 4, kTop + 2 * kCellCss + 4, "defocus control of " + subject.name());
    svg.image({kLeft, kTop}, columns * kCellCss, 2 * kCellCss, canvas.uri());
    for (int i = 0; i < columns; ++i)
        svg.text(
            {kLeft + (i + 0.5) * kCellCss, kTop - 9},
            kTurns[std::size_t(i)] == 0 ? "as it is" : number(kTurns[std::size_t(i)] * waves, 2) + " waves",
            "tick", Anchor::Middle);
    svg.text({kLeft - 8, kTop + 0.5 * kCellCss + 4}, "in front", "name", Anchor::End);
    svg.text({kLeft - 8, kTop + 1.5 * kCellCss + 4}, "behind", "name", Anchor::End);
    return Figure{svg.str(),
                  "This lens with the defocus-control ring of portrait lenses. The ring adds spherical "
                  "aberration: a wavefront that deviates at the rim by " +
                      number(waves, 2) +
                      " waves (588 nm). Turned one way, it makes rings in front of focus and soft discs "
                      "behind; turned the other way, the reverse. <code>petzval lens psf " +
                      escaped(subject.asked()) + " --add-spherical " + number(waves, 2) +
                      " --defocus 40 -o disc.exr</code>",
                  5};
}

}  // namespace petzval::lens_sheet
