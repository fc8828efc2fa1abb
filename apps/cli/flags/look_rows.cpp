#include "flags/look_rows.h"

#include "petzval/defocus.h"
#include "petzval/names.h"

#include "flags/values.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

namespace petzval::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(double value) {
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    return value;
}
Json to_json(int value) { return value; }
Json to_json(std::uint64_t value) { return value; }
Json to_json(const std::string& text) { return text; }
Json to_json(const std::vector<std::string>& texts) { return texts; }
Json to_json(const Interval& interval) { return {to_json(interval.low), to_json(interval.high)}; }
Json to_json(const std::vector<BarrelRim>& rims) {
    Json all = Json::array();
    for (const BarrelRim& rim : rims)
        all.push_back({{"radius_mm", rim.radius_mm}, {"distance_mm", rim.distance_mm}});
    return all;
}
Json to_json(const BarnDoors& doors) { return {doors.left, doors.right, doors.top, doors.bottom}; }

// A placeholder and how its text is read.
struct Kind {
    std::string placeholder;
    std::function<Result<std::string>(const std::string&)> to_json;
};

template <typename Parse>
Kind value(const char* placeholder, Parse parse) {
    return {placeholder, [parse](const std::string& text) -> Result<std::string> {
                const auto parsed = parse(text);
                if (!parsed) return parsed.error();
                return to_json(*parsed).dump(-1, ' ', false, Json::error_handler_t::replace);
            }};
}

// One of a few words, each with its JSON.
Kind one_of(const NameTable<std::string>& words) {
    return {placeholder_of(words), [words](const std::string& text) { return parse_name(text, words); }};
}
template <typename E>
Kind name() {
    NameTable<std::string> words;
    for (const Named<E>& known : names<E>())
        words.emplace_back(known.name, "\"" + std::string(known.name) + "\"");
    return one_of(words);
}
Kind engine() {
    NameTable<std::string> words;
    for (const std::string& known : engine_names()) words.emplace_back(known, "\"" + known + "\"");
    return one_of(words);
}
Kind on_or_off() { return one_of({{"off", "false"}, {"on", "true"}}); }
Kind nothing() { return {}; }

LookRow row(const char* heading, const char* flag, const char* field, Kind kind, const char* help) {
    return {heading, flag, field, std::move(kind.placeholder), help, std::move(kind.to_json)};
}

std::vector<LookRow> rows_of_input_and_focus() {
    return {
        row("Input", "--expand-highlights", "plate.expand_highlights", nothing(),
            "reconstruct the clipped highlights of a plate for the blur; sharp areas are "
            "unchanged"),
        row("Input", "--highlight-peak", "plate.peak", value("LIGHT", parse_positive),
            "scene brightness assumed for pixel value 1.0 (default 16, four stops above white)"),
        row("Input", "--depth-edges", "depth.edges", name<DepthEdges>(),
            "sharpen soft depth edges, as in antialiased depth and in depth maps of neural networks: auto, "
            "only if most edges are soft or many are antialiased (default); snap, always; keep, never"),
        row("Focus", "--focus-range", "focus.range_m", value("M,M", parse_range_m),
            "keep everything between two distances sharp, such as 1.8m,3m"),
        row("Focus", "--focus-falloff", "focus.falloff", value("FRACTION", parse_not_negative),
            "soft transition outside --focus-range, as a fraction of the range limits"),
        row("Focus", "--near-scale", "focus.near_scale", value("FACTOR", parse_not_negative),
            "multiply blur radii in front of focus"),
        row("Focus", "--far-scale", "focus.far_scale", value("FACTOR", parse_not_negative),
            "multiply blur radii behind focus"),
        row("Focus", "--max-radius", "focus.max_radius_px", value("PX", parse_positive),
            "limit the blur radius; smaller radii are unchanged"),
    };
}

std::vector<LookRow> rows_of_lenses() {
    // The third mode, shift, is selected by --focus-shift.
    const Kind focus_mode = one_of({{"best", "\"best\""}, {"paraxial", "\"paraxial\""}});
    return {
        row("Lens", "--lens", "lens.name", value("NAME", parse_text),
            "lens name (petzval lens list), lens file or its content; ideal is a flat disc (default)"),
        row("Lens", "--blades", "lens.blades", value("N", parse_blades),
            "aperture blades, 3 or more; 0 is round (default)"),
        row("Lens", "--blade-rotation", "lens.blade_rotation_deg", value("DEG", parse_number),
            "aperture rotation: angle of the first corner, counter-clockwise from +x, as seen in background "
            "bokeh"),
        row("Lens", "--blade-curvature", "lens.blade_curvature", value("FRACTION", parse_share),
            "blade shape: 0 straight (default) to 1 circular"),
        row("Lens", "--squeeze", "lens.squeeze", value("FACTOR", parse_positive),
            "height of the disc divided by its width, such as 2 for an anamorphic lens"),
        row("Lens", "--cats-eye", "lens.cats_eye", value("FRACTION", parse_share),
            "optical vignetting: cuts discs towards the corners, 0 (default) to 1"),
        row("Lens character", "--focus-mode", "lens.focus_mode", focus_mode,
            "sensor position for a lens with aberrations: best, least blur at this aperture (default); "
            "paraxial, focus of light near the axis"),
        row("Lens character", "--focus-shift", "lens.focus_shift_mm", value("MM", parse_number),
            "move the sensor this far behind the paraxial focus; negative: towards the lens"),
        row("Lens character", "--spherical", "lens.spherical", value("FACTOR", parse_number),
            "multiply the lens's spherical aberration: 1 as built, 0 none, -1 reversed; --add-spherical adds "
            "instead"),
        row("Lens character", "--axial-colour", "lens.axial_colour", value("FACTOR", parse_number),
            "multiply the lens's axial colour"),
        row("Lens character", "--lateral-colour", "lens.lateral_colour", value("FACTOR", parse_number),
            "multiply a prescription's lateral colour (colour fringes off the axis); 0 none"),
        row("Lens character", "--add-spherical", "lens.added_spherical_waves", value("WAVES", parse_number),
            "add spherical aberration to any lens, in waves (588 nm) at the rim; positive: bright rings in "
            "front of focus, soft discs behind; negative: the reverse"),
        row("Lens character", "--add-at-fstop", "lens.added_at_f_number", value("N", parse_f_number),
            "f-number to which --add-spherical refers (default: the camera's); stopped down, it falls with "
            "the fourth power"),
        row("Lens character", "--add-axial-colour", "lens.added_axial_colour_mm", value("MM", parse_number),
            "distance of the blue focus (486 nm) behind the red one (656 nm); negative as in simple lenses"),
        row("Lens character", "--add-field-curvature", "lens.added_field_curvature_mm",
            value("MM", parse_number),
            "distance of the corners' focus behind the sensor; negative as in simple lenses"),
        row("Lens character", "--add-lateral-colour", "lens.added_lateral_colour_percent",
            value("PERCENT", parse_number),
            "size of the blue image (486 nm) relative to the red one (656 nm), in percent more"),
        row("Lens character", "--coma", "lens.coma", value("AMOUNT", parse_number),
            "add coma off the axis, 1 is strong; positive tails point outward"),
        row("Lens character", "--astigmatism", "lens.astigmatism", value("AMOUNT", parse_number),
            "add astigmatism off the axis, 1 is strong; positive: strokes circle the middle behind focus "
            "(swirl)"),
        row("Lens character", "--distortion", "lens.distortion", value("FRACTION", parse_number),
            "distort the picture and its discs: stretch towards the corners by this fraction; negative: "
            "barrel"),
        row("Lens character", "--light", "lens.light", name<LightSpectrum>(),
            "spectrum of the light (default daylight): a lamp's lines focus separately, so its discs have no "
            "rainbow"),
        row("Lens character", "--wavelengths", "lens.wavelengths", value("N", parse_count),
            "number of spectral bands (default: as many as needed)"),
        row("Lens character", "--wave", "lens.wave", nothing(),
            "diffraction: rings in discs of small sensors, spikes of blades; slow on small sensors"),
    };
}

std::vector<LookRow> rows_of_pupils() {
    return {
        row("Pupil", "--iris-open", "lens.iris_open", value("N", parse_f_number),
            "f-number at which the iris is round; blades show as it closes"),
        row("Pupil", "--barrel", "lens.barrel", value("R,D", parse_barrel),
            "barrel rim: radius and distance in front of the pupil, in mm; cuts the outer side of discs "
            "behind focus, or the inner side if the distance is negative; separate several with ;"),
        row("Pupil", "--barn-doors", "lens.barn_doors", value("L,R,T,B", parse_barn_doors),
            "matte box doors, in pupil radii from each side"),
        row("Pupil", "--aperture-image", "lens.aperture_image", value("FILE", parse_text),
            "transmission of the pupil (PNG or EXR), upright as behind focus"),
        row("Pupil", "--kernel-image", "lens.kernel_image", value("FAR[,NEAR]", parse_one_or_two_files),
            "photographed or drawn disc instead of a lens; one, or one for each side of focus"),
        row("Pupil", "--dust", "lens.dust", value("FRACTION", parse_share),
            "dust specks, 0 to 1; visible in large discs"),
        row("Pupil", "--scratches", "lens.scratches", value("FRACTION", parse_share),
            "scratches on the glass, 0 to 1"),
        row("Pupil", "--onion-rings", "lens.onion_rings", value("FRACTION", parse_share),
            "turning marks of a moulded asphere, 0 to 1"),
        row("Pupil", "--texture-seed", "lens.texture_seed", value("N", parse_seed),
            "seed for the position of dust, scratches and rings"),
    };
}

std::vector<LookRow> rows_of_glare() {
    return {
        row("Glare", "--bloom", "glare.bloom", value("FRACTION", parse_share),
            "glow around all light: the fraction of light that it spreads, such as 0.1"),
        row("Glare", "--bloom-radius", "glare.bloom_radius", value("FRACTION", parse_positive),
            "standard deviation of the widest bloom layer, in picture heights (default 0.08)"),
        row("Glare", "--bloom-threshold", "glare.bloom_threshold", value("LIGHT", parse_not_negative),
            "only light above this glows; 1 is diffuse white, 0 all light (default)"),
        row("Glare", "--star", "glare.star", value("FRACTION", parse_share),
            "diffraction stars around highlights: the fraction of their light, such as 0.1; needs --blades"),
        row("Glare", "--star-radius", "glare.star_radius", value("FRACTION", parse_positive),
            "distance from the highlight to the end of its star's red rays, in picture heights (default "
            "0.5)"),
        row("Glare", "--star-quality", "glare.star_quality", name<StarQuality>(),
            "final: diffraction by wavelength (default); draft: quick streaks"),
        row("Glare", "--ghosts", "glare.ghosts", value("FRACTION", parse_share),
            "reflections of highlights: between the surfaces of a prescription, otherwise coloured copies"),
        row("Glare", "--coating", "glare.coating", name<LensCoating>(),
            "coating of reflecting surfaces: single layer (default) or none"),
        row("Glare", "--veil", "glare.veil", value("FRACTION", parse_share),
            "spread this fraction of all light evenly"),
        row("Glare", "--glare-threshold", "glare.threshold", value("LIGHT", parse_not_negative),
            "stars and ghosts use light above this; 1 is diffuse white (default)"),
        row("Glare", "--vignetting", "glare.vignetting", nothing(),
            "light falloff towards the corners: cos^4 and barrel vignetting"),
    };
}

std::vector<LookRow> rows_of_engines() {
    return {
        row("Engine", "--engine", "engine", engine(), "method that computes the blur (default scatter)"),
        row("Engine", "--quality", "quality", name<Quality>(),
            "accuracy of the blur, not its size (default standard)"),
        row("Engine", "--fill", "fill", name<Fill>(),
            "how to fill the background hidden behind foreground edges: full, extends the surroundings "
            "(default); dim, extends them without highlights; off, adds nothing"),
        row("Engine", "--pupil-points", "pupil_points", value("N", parse_count),
            "rays per pixel of --engine reference (default 4096)"),
        row("Engine", "--seed", "seed", value("N", parse_seed), "seed of --engine reference (default 1)"),
        row("Engine gather", "--gather-stage", "gather.stage", name<GatherStage>(),
            "debug: output an intermediate stage of the published method; final is the engine itself "
            "(default)"),
        row("Engine gather", "--gather-taps", "gather.taps",
            one_of({{"16", "16"}, {"22", "22"}, {"43", "43"}, {"71", "71"}}),
            "samples of the published disc (default 43)"),
        row("Engine gather", "--gather-tap-offset", "gather.tap_offset", value("N", parse_positive),
            "published four-tap blur: tap offset in half-size pixels (default 0.5, a tent; published: 1; at "
            "most 4)"),
        row("Engine gather", "--gather-pixel-size", "gather.pixel_size_px", value("PX", parse_not_negative),
            "published combine and cure: radii up to this stay sharp (default 0.2; less than 1)"),
        row("Engine gather", "--gather-blurred-from", "gather.blurred_px", value("PX", parse_positive),
            "published combine and cure: radii from this on are fully blurred (default 1, in cure 1.2, as "
            "published; at least 1)"),
        row("Engine gather", "--gather-coc", "gather.coc",
            one_of({{"mean", "\"mean\""}, {"extreme", "\"extreme\""}}),
            "radius of 2 x 2 pixels in the published prefilter (default mean)"),
        row("Engine gather", "--gather-fill", "gather.fill", on_or_off(),
            "extend background under soft foreground edges (default on)"),
        row("Engine gaussian", "--gaussian-style", "gaussian.style", name<GaussianStyle>(),
            "layered: near and far separated (default); plain: by each pixel's radius; wgld: by depth, as "
            "published"),
        row("Engine gaussian", "--focus-band", "gaussian.focus_band", value("N", parse_not_negative),
            "keep radii up to N px sharp (default 0); wgld: the band's fraction of the depth range (default "
            "0.2)"),
        row("Engine gaussian", "--depth-offset", "gaussian.depth_offset", value("N", parse_number),
            "wgld: offset added to the depth of 0 to 1 (default: puts the focus into the band)"),
        row("Engine gaussian", "--depth-along", "gaussian.depth_along",
            one_of({{"axis", "\"axis\""}, {"ray", "\"ray\""}}),
            "wgld: measure depth along the axis (default) or along the ray"),
        row("Engine gaussian", "--depth-band-range", "gaussian.depth_band_range_m",
            value("NEAR,FAR", parse_range_m),
            "wgld: depths that map to 0 and 1, such as 0.1m,30m; default: the picture's range"),
        row("Engine sprites", "--background", "sprites.background", name<SpriteBackground>(),
            "engine that draws everything except the lights (default gather)"),
        row("Engine sprites", "--find-points", "sprites.find_points", on_or_off(),
            "draw bright points of the picture with whole kernels (default on); also for gather"),
        row("Engine sprites", "--bright-factor", "sprites.bright_factor", value("N", parse_positive),
            "a bright point is this many times brighter than its surroundings (default 3); also for gather"),
    };
}

}  // namespace

const std::vector<LookRow>& look_rows() {
    static const std::vector<LookRow> all = [] {
        std::vector<LookRow> rows;
        for (const auto& part : {rows_of_input_and_focus(), rows_of_lenses(), rows_of_pupils(),
                                 rows_of_glare(), rows_of_engines()})
            rows.insert(rows.end(), part.begin(), part.end());
        return rows;
    }();
    return all;
}

namespace {

std::string typed(const Json& value) {
    if (value.is_null()) return "";
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const Json& part : value) {
        if (part.is_object())  // a rim of a barrel
            text += (text.empty() ? "" : ";") + typed(part["radius_mm"]) + "," + typed(part["distance_mm"]);
        else
            text += (text.empty() ? "" : ",") + typed(part);
    }
    return text;
}

}  // namespace

std::string typed_text(const std::string& json) { return typed(Json::parse(json)); }

}  // namespace petzval::cli
