// pbrt lens files (mmp/pbrt-v4): four numbers a line from the front: radius, thickness, index behind,
// aperture DIAMETER, in mm. Radius 0 is the stop; '#' starts a comment. The last thickness is not to be
// trusted (pbrt focuses by itself), and one index stands for all wavelengths.
#include "lens_files/readers.h"

#include <array>
#include <cmath>

namespace petzval::lens_files {

Result<LensFile> read_pbrt(const std::string& text) {
    LensFile file;
    file.format = "pbrt .dat";
    bool has_stop = false;
    for (const Line& line : split_lines(text)) {
        const std::size_t hash = line.text.find('#');
        if (hash != std::string_view::npos && file.lens.source.empty())
            file.lens.source = std::string(trimmed(line.text.substr(hash + 1)));
        const auto words = split_words(line.text.substr(0, hash));
        if (words.empty()) continue;
        if (words.size() != 4)
            return at_line(line.number,
                           "a pbrt lens has four numbers a line (radius, thickness, index, aperture "
                           "diameter), here are " +
                               std::to_string(words.size()));
        std::array<double, 4> row{};
        for (std::size_t i = 0; i < 4; ++i) {
            const auto number = parse_number(words[i]);
            if (!number || !std::isfinite(*number))
                return at_line(line.number, quoted(words[i]) + " is not a number");
            row[i] = *number;
        }
        const auto& [radius, thickness, index, diameter] = row;
        if (!(diameter > 0)) return at_line(line.number, "the aperture diameter must be positive");
        optics::Surface surface;
        surface.thickness_mm = thickness;
        surface.clear_radius_mm = diameter / 2;
        if (index != 0 && index != 1)
            surface.after = optics::constant_glass("n " + std::string(words[2]), index);
        if (radius == 0) {
            if (has_stop)
                return at_line(line.number, "a second stop (radius 0); planes are not part of the format");
            has_stop = true;
            file.lens.stop = int(file.lens.surfaces.size());
            file.lens.aperture = diameter / 2;
        } else {
            surface.curvature_per_mm = 1 / radius;
        }
        if (file.lens.surfaces.size() >= std::size_t(optics::kMostSurfaces))
            return at_line(line.number, "more than " + std::to_string(optics::kMostSurfaces) + " surfaces");
        file.lens.surfaces.push_back(std::move(surface));
    }
    if (!has_stop) return at_line(1, "no line has radius 0: the lens has no stop");
    file.lens.aperture_kind = optics::ApertureKind::StopRadius;
    warn_of_models(file);
    assume_field(file);
    return file;
}

}  // namespace petzval::lens_files
