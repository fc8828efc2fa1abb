#include "lens.h"

#include "values.h"

#include <filesystem>

namespace petzval::cli {

void LensFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Lens")
        .value("--lens", "NAME", "a lens by name, or a lens file; ideal is a flat disc (default)", parse_text,
               name);
    add_shape_to(verb);
}

void LensFlags::add_shape_to(Verb& verb) {
    FlagGroup(verb, "Lens")
        .value("--blades", "N", "blades of the aperture, 3 or more; 0 is round (default)", parse_blades,
               blades)
        .value("--blade-rotation", "DEG", "first corner, counter-clockwise from the right, in the far disc",
               parse_number, rotation_deg)
        .value("--blade-curvature", "SHARE", "0 straight edges (default) to 1 circle", parse_share, curvature)
        .value("--squeeze", "FACTOR",
               "the disc is so many times taller than wide, as 2 for an anamorphic lens", parse_positive,
               squeeze)
        .value("--cats-eye", "SHARE", "0 (default) to 1: how far the barrel cuts discs towards the corners",
               parse_share, cats_eye);
}

void LensFlags::add_character_to(Verb& verb) { character.add_to(verb); }

std::vector<std::string> LensFlags::input_files() const {
    std::vector<std::string> files = character.input_files();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(name, ignored)) files.push_back(name);
    return files;
}

void LensFlags::check() const {
    const bool round = blades.value_or(0) == 0;
    if (round && rotation_deg)
        throw UsageError("--blade-rotation has no effect without --blades, as --blades 5");
    if (round && curvature)
        throw UsageError("--blade-curvature has no effect without --blades, as --blades 5");
    character.check(name, !round);
}

LensChoice LensFlags::choice() const {
    LensChoice lens;
    lens.name = name;
    lens.aperture.blades = blades.value_or(0);
    lens.aperture.rotation_deg = rotation_deg.value_or(0);
    lens.aperture.curvature = curvature.value_or(0);
    lens.aperture.squeeze = squeeze.value_or(1);
    lens.cats_eye = cats_eye.value_or(0);
    character.apply_to(lens);
    return lens;
}

}  // namespace petzval::cli
