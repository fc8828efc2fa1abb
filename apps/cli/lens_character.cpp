#include "lens_character.h"

#include "petzval/files.h"

#include "values.h"

#include <algorithm>

namespace petzval::cli {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts{""};
    for (const char c : text)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

Error must_be(const std::string& what) { return {ErrorCode::InvalidArgument, "must be " + what}; }

// "14mm,20mm;14mm,-20mm"
Result<std::vector<BarrelRim>> parse_barrel(const std::string& text) {
    const auto wrong = must_be("rims as RADIUS,DISTANCE in mm, several with ; between, as \"14,20;14,-20\"");
    std::vector<BarrelRim> rims;
    for (const std::string& rim : split(text, ';')) {
        const auto numbers = split(rim, ',');
        if (numbers.size() != 2) return wrong;
        const auto radius = parse_length_mm(numbers[0]);
        const bool behind = numbers[1].rfind('-', 0) == 0;
        const std::string length = numbers[1].substr(behind ? 1 : 0);
        // A rim at the pupil itself has no distance, which is no length.
        const auto zero = parse_number(length);
        const auto distance = zero && *zero == 0 ? Result<double>(0.0) : parse_length_mm(length);
        if (!radius || !distance) return wrong;
        rims.push_back({*radius, behind ? -*distance : *distance});
    }
    return rims;
}

Result<BarnDoors> parse_barn_doors(const std::string& text) {
    const auto wrong =
        must_be("four numbers, left, right, top and bottom, 0 (open) to below 2, as 0.5,0,0,0.2");
    std::vector<double> doors;
    for (const std::string& part : split(text, ',')) {
        const auto door = parse_not_negative(part);
        if (!door || !(*door < 2)) return wrong;
        doors.push_back(*door);
    }
    if (doors.size() != 4) return wrong;
    return BarnDoors{doors[0], doors[1], doors[2], doors[3]};
}

// Shift is said by its own flag.
const NameTable<FocusMode> kFocusModes{{name_of(FocusMode::Best), FocusMode::Best},
                                       {name_of(FocusMode::Paraxial), FocusMode::Paraxial}};

struct NamedFlag {
    const char* name;
    bool given;
};

bool is_exr(const std::string& path) {
    const auto dot = path.rfind('.');
    return dot != std::string::npos && (path.substr(dot) == ".exr" || path.substr(dot) == ".EXR");
}

Result<Picture> read_picture(const std::string& path, int threads) {
    ReadOptions options;
    options.threads = threads;
    options.need_depth = false;
    auto frame = read_frame(path, options);
    if (!frame) return frame.error();
    return std::move(frame->colour);
}

// Transmission: a PNG as stored, 0 to white; an EXR's luminance.
Result<Plane> read_transmission(const std::string& path, int threads) {
    if (is_exr(path)) {
        const auto picture = read_picture(path, threads);
        if (!picture) return picture.error();
        Plane plane(picture->width(), picture->height());
        for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = luminance(picture->pixels()[i]);
        return plane;
    }
    const auto png = read_png(path);
    if (!png) return png.error();
    Plane plane(png->width, png->height);
    const float white = png->bits == 16 ? 65535.0f : 255.0f;
    const auto channels = std::size_t(png->channels),
               colours = channels >= 3 ? std::size_t(3) : std::size_t(1);
    for (std::size_t i = 0; i < plane.size(); ++i) {
        float sum = 0;
        for (std::size_t c = 0; c < colours; ++c) sum += float(png->samples[i * channels + c]);
        plane.pixels()[i] = sum / (float(colours) * white);
    }
    return plane;
}

Error from_flag(const char* flag, const Error& error) {
    return {error.code, std::string(flag) + ": " + error.message};
}

}  // namespace

void LensCharacterFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Lens character")
        .choice("--focus-mode",
                "where the sensor stands behind a lens with aberrations: best, least blur at this aperture "
                "(default); "
                "paraxial, where light near the axis meets",
                kFocusModes, focus_mode)
        .value("--focus-shift", "MM",
               "the sensor this far behind the paraxial focus; negative is nearer the lens", parse_number,
               focus_shift_mm)
        .value("--spherical", "FACTOR", "times its spherical aberration: 1 as built, 0 none, -1 reversed",
               parse_number, spherical)
        .value("--axial-colour", "FACTOR", "times its axial colour", parse_number, axial_colour)
        .value("--lateral-colour", "FACTOR",
               "times a prescription's lateral colour, that colours land apart off the axis; 0 none",
               parse_number, lateral_colour)
        .value("--coma", "AMOUNT", "added off the axis, 1 is strong; positive tails point outward",
               parse_number, coma)
        .value("--astigmatism", "AMOUNT", "added off the axis, 1 is strong: swirl", parse_number, astigmatism)
        .value("--distortion", "SHARE",
               "discs, and the picture of defocus with them, stretch towards the corners by this share",
               parse_number, distortion)
        .value("--wavelengths", "N", "bands of the spectrum; as many as needed by default", parse_count,
               wavelengths)
        .on("--wave", "diffraction: rings in discs of small sensors, spikes of blades; slow", wave);
    FlagGroup(verb, "Pupil")
        .value("--iris-open", "N", "f-number at which the iris is open and round; blades show as it closes",
               parse_f_number, iris_open)
        .value("--barrel", "R,D",
               "a rim of this radius so far in front of the pupil, mm; several with ; between", parse_barrel,
               barrel)
        .value("--barn-doors", "L,R,T,B", "doors of a matte box, in pupil radii from each side",
               parse_barn_doors, barn_doors)
        .value("--aperture-image", "FILE", "transmission of the pupil, upright as behind focus: PNG or EXR",
               parse_text, aperture_image)
        .value(
            "--kernel-image", "FAR[,NEAR]",
            "a disc as photographed or drawn, instead of a lens; one for each side",
            [](const std::string& text) -> Result<std::vector<std::string>> {
                const auto files = split(text, ',');
                if (files.size() > 2 || std::count(files.begin(), files.end(), "") > 0)
                    return must_be("one file, or two with a comma between");
                return files;
            },
            kernel_images)
        .value("--dust", "SHARE", "specks of dust, 0 to 1; seen in large discs", parse_share, dust)
        .value("--scratches", "SHARE", "scratches on the glass, 0 to 1", parse_share, scratches)
        .value("--onion-rings", "SHARE", "turning marks of a moulded asphere, 0 to 1", parse_share,
               onion_rings)
        .value("--texture-seed", "N", "where dust, scratches and rings lie", parse_seed, texture_seed);
}

void LensCharacterFlags::check(const std::string& lens, bool has_blades) const {
    refuse_both(focus_mode.has_value(), "--focus-mode", focus_shift_mm.has_value(), "--focus-shift");
    if (lens == "ideal")
        for (const auto& [name, given] : {NamedFlag{"--focus-mode", focus_mode.has_value()},
                                          {"--focus-shift", focus_shift_mm.has_value()},
                                          {"--spherical", spherical.has_value()},
                                          {"--axial-colour", axial_colour.has_value()},
                                          {"--lateral-colour", lateral_colour.has_value()}})
            if (given)
                throw UsageError(std::string(name) +
                                 " has no effect on the ideal lens; give another with --lens");
    if (iris_open && !has_blades)
        throw UsageError("--iris-open has no effect without --blades, as --blades 7");
    if (texture_seed && !dust && !scratches && !onion_rings)
        throw UsageError("--texture-seed has no effect without --dust, --scratches or --onion-rings");
    refuse_both(wave, "--wave", !kernel_images.empty(), "--kernel-image");
}

std::vector<std::string> LensCharacterFlags::input_files() const {
    std::vector<std::string> files = kernel_images;
    if (!aperture_image.empty()) files.push_back(aperture_image);
    return files;
}

Status LensCharacterFlags::load(int threads) {
    if (!aperture_image.empty()) {
        auto plane = read_transmission(aperture_image, threads);
        if (!plane) return from_flag("--aperture-image", plane.error());
        aperture_ = std::make_shared<const Plane>(std::move(*plane));
    }
    for (std::size_t i = 0; i < kernel_images.size(); ++i) {
        auto picture = read_picture(kernel_images[i], threads);
        if (!picture) return from_flag("--kernel-image", picture.error());
        (i == 0 ? kernels_.far : kernels_.near) = std::make_shared<const Picture>(std::move(*picture));
    }
    return Done{};
}

void LensCharacterFlags::apply_to(LensChoice& lens) const {
    lens.focus_mode = focus_shift_mm ? FocusMode::Shift : focus_mode.value_or(FocusMode::Best);
    lens.focus_shift_mm = focus_shift_mm.value_or(0);
    lens.spherical = spherical.value_or(1);
    lens.axial_colour = axial_colour.value_or(1);
    lens.lateral_colour = lateral_colour.value_or(1);
    lens.coma = coma.value_or(0);
    lens.astigmatism = astigmatism.value_or(0);
    lens.distortion = distortion.value_or(0);
    lens.wavelengths = wavelengths.value_or(0);
    lens.wave = wave;
    lens.aperture.round_at_f_number = iris_open.value_or(0);
    lens.barrel = barrel;
    lens.barn_doors = barn_doors.value_or(BarnDoors{});
    lens.texture = {aperture_, dust.value_or(0), scratches.value_or(0), onion_rings.value_or(0),
                    texture_seed.value_or(1)};
    lens.kernel_images = kernels_;
}

Json character_json(const LensChoice& lens) {
    Json rims = Json::array();
    for (const BarrelRim& rim : lens.barrel)
        rims.push_back({{"radius_mm", rim.radius_mm}, {"distance_mm", rim.distance_mm}});
    const BarnDoors& doors = lens.barn_doors;
    return {{"focus_mode", name_of(lens.focus_mode)},
            {"focus_shift_mm", lens.focus_shift_mm},
            {"spherical", lens.spherical},
            {"axial_colour", lens.axial_colour},
            {"lateral_colour", lens.lateral_colour},
            {"coma", lens.coma},
            {"astigmatism", lens.astigmatism},
            {"distortion", lens.distortion},
            {"wavelengths", lens.wavelengths},
            {"wave", lens.wave},
            {"iris_open", lens.aperture.round_at_f_number},
            {"barrel", rims},
            {"barn_doors", {doors.left, doors.right, doors.top, doors.bottom}},
            {"aperture_image", lens.texture.image != nullptr},
            {"kernel_image", lens.kernel_images.far != nullptr},
            {"dust", lens.texture.dust},
            {"scratches", lens.texture.scratches},
            {"onion_rings", lens.texture.onion_rings},
            {"texture_seed", lens.texture.seed}};
}

}  // namespace petzval::cli
