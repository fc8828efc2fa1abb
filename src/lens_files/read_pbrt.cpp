// pbrt lens files (mmp/pbrt-v4): four numbers a line from the front: radius, thickness, index behind,
// aperture DIAMETER, in mm. Radius 0 is the stop; '#' starts a comment. The last thickness is not to be
// trusted (pbrt focuses by itself), and one index stands for all wavelengths.
#include "lens_files/readers.h"

#include <array>
#include <cmath>

namespace petzval::lens_files {
namespace {

using Row = std::array<double, 4>;

Result<Row> row_of(const Line& line, const std::vector<std::string_view>& words) {
    if (words.size() != 4)
        return at_line(line.number,
                       "a pbrt lens has four numbers a line (radius, thickness, index, aperture diameter), "
                       "here are " +
                           std::to_string(words.size()));
    Row row{};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto number = parse_number(words[i]);
        if (!number || !std::isfinite(*number))
            return at_line(line.number, quoted(words[i]) + " is not a number");
        row[i] = *number;
    }
    if (!(row[3] > 0)) return at_line(line.number, "the aperture diameter must be positive");
    return row;
}

optics::Surface surface_of(const Row& row) {
    const auto& [radius, thickness, index, diameter] = row;
    optics::Surface surface;
    surface.curvature_per_mm = radius == 0 ? 0 : 1 / radius;
    surface.thickness_mm = thickness;
    surface.clear_radius_mm = diameter / 2;
    if (index != 0 && index != 1) surface.after = optics::constant_glass("n", index);
    return surface;
}

}  // namespace

Result<LensFile> read_pbrt(const std::string& text) {
    LensFile file;
    file.format = "pbrt .dat";
    optics::Prescription& lens = file.lens;
    bool has_stop = false;
    for (const Line& line : split_lines(text)) {
        const std::size_t hash = line.text.find('#');
        if (hash != std::string_view::npos && lens.source.empty())
            lens.source = std::string(trimmed(line.text.substr(hash + 1)));
        const auto words = split_words(line.text.substr(0, hash));
        if (words.empty()) continue;
        const auto row = row_of(line, words);
        if (!row) return row.error();
        if (lens.surfaces.size() >= std::size_t(optics::kMostSurfaces))
            return at_line(line.number, "more than " + std::to_string(optics::kMostSurfaces) + " surfaces");
        if ((*row)[0] == 0) {
            if (has_stop)
                return at_line(line.number, "a second stop (radius 0); planes are not part of the format");
            has_stop = true;
            lens.stop = int(lens.surfaces.size());
            lens.aperture = (*row)[3] / 2;
        }
        lens.surfaces.push_back(surface_of(*row));
    }
    if (!has_stop) return at_line(1, "no line has radius 0: the lens has no stop");
    lens.aperture_kind = optics::ApertureKind::StopRadius;
    warn_of_models(file);
    assume_field(file);
    return file;
}

}  // namespace petzval::lens_files
