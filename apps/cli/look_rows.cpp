#include "look_rows.h"

#include "petzval/defocus.h"
#include "petzval/look_check.h"
#include "petzval/look_json.h"
#include "petzval/names.h"

#include "values.h"

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
            "for plates that end at 1: blur as if their highlights were as bright as they once were, then "
            "go back; what is sharp stays as it is"),
        row("Input", "--highlight-peak", "plate.peak", value("LIGHT", parse_positive),
            "what 1 stood for then (default 16, four stops above white)"),
        row("Input", "--depth-edges", "depth.edges", name<DepthEdges>(),
            "silhouettes that are ramps, as in depth of networks: each pixel goes to one side where most are "
            "(auto, default) or wherever there is one (snap), or they stay (keep)"),
        row("Focus", "--focus-range", "focus.range_m", value("M,M", parse_range_m),
            "keep everything between two distances sharp, as 1.8m,3m"),
        row("Focus", "--focus-falloff", "focus.falloff", value("SHARE", parse_not_negative),
            "ease blur in beyond the range over this share of its ends' distance"),
        row("Focus", "--near-scale", "focus.near_scale", value("FACTOR", parse_not_negative),
            "multiply radii in front of focus"),
        row("Focus", "--far-scale", "focus.far_scale", value("FACTOR", parse_not_negative),
            "multiply radii behind focus"),
        row("Focus", "--max-radius", "focus.max_radius_px", value("PX", parse_positive),
            "cut radii off here; smaller ones stay as they are"),
    };
}

std::vector<LookRow> rows_of_lenses() {
    // Shift is said by its own flag.
    const Kind focus_mode = one_of({{"best", "\"best\""}, {"paraxial", "\"paraxial\""}});
    return {
        row("Lens", "--lens", "lens.name", value("NAME", parse_text),
            "a lens by name, or a lens file; ideal is a flat disc (default)"),
        row("Lens", "--blades", "lens.blades", value("N", parse_blades),
            "blades of the aperture, 3 or more; 0 is round (default)"),
        row("Lens", "--blade-rotation", "lens.blade_rotation_deg", value("DEG", parse_number),
            "first corner, counter-clockwise from the right, in the far disc"),
        row("Lens", "--blade-curvature", "lens.blade_curvature", value("SHARE", parse_share),
            "0 straight edges (default) to 1 circle"),
        row("Lens", "--squeeze", "lens.squeeze", value("FACTOR", parse_positive),
            "the disc is so many times taller than wide, as 2 for an anamorphic lens"),
        row("Lens", "--cats-eye", "lens.cats_eye", value("SHARE", parse_share),
            "0 (default) to 1: how far a rim in front of the pupil cuts discs towards the corners"),
        row("Lens character", "--focus-mode", "lens.focus_mode", focus_mode,
            "where the sensor stands behind a lens with aberrations: best, least blur at this aperture "
            "(default); paraxial, where light near the axis meets"),
        row("Lens character", "--focus-shift", "lens.focus_shift_mm", value("MM", parse_number),
            "the sensor this far behind the paraxial focus; negative is nearer the lens"),
        row("Lens character", "--spherical", "lens.spherical", value("FACTOR", parse_number),
            "times its spherical aberration: 1 as built, 0 none, -1 reversed"),
        row("Lens character", "--axial-colour", "lens.axial_colour", value("FACTOR", parse_number),
            "times its axial colour"),
        row("Lens character", "--lateral-colour", "lens.lateral_colour", value("FACTOR", parse_number),
            "times a prescription's lateral colour, that colours land apart off the axis; 0 none"),
        row("Lens character", "--add-spherical", "lens.added_spherical_waves", value("WAVES", parse_number),
            "defocus control of any lens: spherical aberration of so many waves (588 nm) at the rim; "
            "positive, "
            "bright rings in front of focus and soft discs behind; negative, the reverse"),
        row("Lens character", "--add-at-fstop", "lens.added_at_f_number", value("N", parse_f_number),
            "the f-number that --add-spherical is stated for (default: the camera's); stopped down, it falls "
            "with the fourth power"),
        row("Lens character", "--add-axial-colour", "lens.added_axial_colour_mm", value("MM", parse_number),
            "blue (486 nm) focuses so far behind red (656 nm); negative as in simple lenses, nearer the "
            "lens"),
        row("Lens character", "--add-field-curvature", "lens.added_field_curvature_mm",
            value("MM", parse_number),
            "the frame's corners focus so far behind the sensor; negative as in simple lenses, before it"),
        row("Lens character", "--add-lateral-colour", "lens.added_lateral_colour_percent",
            value("PERCENT", parse_number),
            "the blue image (486 nm) is so much larger than the red one (656 nm)"),
        row("Lens character", "--coma", "lens.coma", value("AMOUNT", parse_number),
            "added off the axis, 1 is strong; positive tails point outward"),
        row("Lens character", "--astigmatism", "lens.astigmatism", value("AMOUNT", parse_number),
            "added off the axis, 1 is strong: behind focus strokes round the middle, swirl; negative, from "
            "it"),
        row("Lens character", "--distortion", "lens.distortion", value("SHARE", parse_number),
            "discs, and the picture of defocus with them, stretch towards the corners by this share"),
        row("Lens character", "--light", "lens.light", name<LightSpectrum>(),
            "what the light is made of (default daylight): a lamp's lines land where their own wavelengths "
            "do, "
            "and its discs have no rainbow"),
        row("Lens character", "--wavelengths", "lens.wavelengths", value("N", parse_count),
            "bands of the spectrum; as many as needed by default"),
        row("Lens character", "--wave", "lens.wave", nothing(),
            "diffraction: rings in discs of small sensors, spikes of blades; slow"),
    };
}

std::vector<LookRow> rows_of_pupils() {
    return {
        row("Pupil", "--iris-open", "lens.iris_open", value("N", parse_f_number),
            "f-number at which the iris is open and round; blades show as it closes"),
        row("Pupil", "--barrel", "lens.barrel", value("R,D", parse_barrel),
            "a rim of this radius so far in front of the pupil, mm: it cuts the outer side of discs behind "
            "focus, "
            "a negative distance the inner; several with ; between"),
        row("Pupil", "--barn-doors", "lens.barn_doors", value("L,R,T,B", parse_barn_doors),
            "doors of a matte box, in pupil radii from each side"),
        row("Pupil", "--aperture-image", "lens.aperture_image", value("FILE", parse_text),
            "transmission of the pupil, upright as behind focus: PNG or EXR"),
        row("Pupil", "--kernel-image", "lens.kernel_image", value("FAR[,NEAR]", parse_one_or_two_files),
            "a disc as photographed or drawn, instead of a lens; one for each side"),
        row("Pupil", "--dust", "lens.dust", value("SHARE", parse_share),
            "specks of dust, 0 to 1; seen in large discs"),
        row("Pupil", "--scratches", "lens.scratches", value("SHARE", parse_share),
            "scratches on the glass, 0 to 1"),
        row("Pupil", "--onion-rings", "lens.onion_rings", value("SHARE", parse_share),
            "turning marks of a moulded asphere, 0 to 1"),
        row("Pupil", "--texture-seed", "lens.texture_seed", value("N", parse_seed),
            "where dust, scratches and rings lie"),
    };
}

std::vector<LookRow> rows_of_glare() {
    return {
        row("Glare", "--bloom", "glare.bloom", value("SHARE", parse_share),
            "a glow around all light, which takes this share of it, as 0.1"),
        row("Glare", "--bloom-radius", "glare.bloom_radius", value("SHARE", parse_positive),
            "standard deviation of its widest layer, in heights of the picture (default 0.08)"),
        row("Glare", "--bloom-threshold", "glare.bloom_threshold", value("LIGHT", parse_not_negative),
            "only the light above this glows; 1 is diffuse white, 0 all light (default)"),
        row("Glare", "--star", "glare.star", value("SHARE", parse_share),
            "stars around highlights, by diffraction at the --blades, as 0.1"),
        row("Glare", "--star-radius", "glare.star_radius", value("SHARE", parse_positive),
            "where their red light ends, in heights of the picture (default 0.5)"),
        row("Glare", "--star-quality", "glare.star_quality", name<StarQuality>(),
            "final (default): diffraction, by wavelength; draft: quick streaks"),
        row("Glare", "--ghosts", "glare.ghosts", value("SHARE", parse_share),
            "reflections of highlights: of the --lens's surfaces if it is a prescription, else coloured "
            "copies"),
        row("Glare", "--coating", "glare.coating", name<LensCoating>(),
            "of the surfaces that reflect: single layer (default), none"),
        row("Glare", "--veil", "glare.veil", value("SHARE", parse_share),
            "spread this share of all light evenly"),
        row("Glare", "--glare-threshold", "glare.threshold", value("LIGHT", parse_not_negative),
            "stars and ghosts are made of the light above this; 1 is diffuse white (default)"),
        row("Glare", "--vignetting", "glare.vignetting", nothing(),
            "light lost towards the corners: cos^4 and what the barrel cuts off"),
    };
}

std::vector<LookRow> rows_of_engines() {
    return {
        row("Engine", "--engine", "engine", engine(), "what computes the blur (default scatter)"),
        row("Engine", "--quality", "quality", name<Quality>(),
            "accuracy only, never the size of the blur (default standard)"),
        row("Engine", "--fill", "fill", name<Fill>(),
            "behind edges, where nothing is known: what is around goes on (full, default); of lamps only "
            "what "
            "shows (dim); nothing is added (off)"),
        row("Engine", "--pupil-points", "pupil_points", value("N", parse_count),
            "rays per pixel of --engine reference (default 4096)"),
        row("Engine", "--seed", "seed", value("N", parse_seed),
            "start of all random choices of --engine reference (default 1)"),
        row("Engine gather", "--gather-stage", "gather.stage", name<GatherStage>(),
            "a stop of the published method in place of the result; final (default) is the engine itself"),
        row("Engine gather", "--gather-taps", "gather.taps",
            one_of({{"16", "16"}, {"22", "22"}, {"43", "43"}, {"71", "71"}}),
            "samples of the published disc (default 43)"),
        row("Engine gather", "--gather-tap-offset", "gather.tap_offset", value("N", parse_positive),
            "published four-tap blur: how far its taps stand off, in half-size pixels (default 0.5, a tent; "
            "published: 1; at most 4)"),
        row("Engine gather", "--gather-pixel-size", "gather.pixel_size_px", value("PX", parse_not_negative),
            "published combine and cure: radii up to this stay sharp (default 0.2; less than 1)"),
        row("Engine gather", "--gather-blurred-from", "gather.blurred_px", value("PX", parse_positive),
            "published combine and cure: radii from this on are wholly blurred (default 1, in cure 1.2, as "
            "published; at least 1)"),
        row("Engine gather", "--gather-coc", "gather.coc",
            one_of({{"mean", "\"mean\""}, {"extreme", "\"extreme\""}}),
            "the radius of 2 x 2 pixels in the published prefilter (default mean)"),
        row("Engine gather", "--gather-fill", "gather.fill", on_or_off(),
            "continue what near things hide under their soft edges (default on)"),
        row("Engine gaussian", "--gaussian-style", "gaussian.style", name<GaussianStyle>(),
            "near and far apart (layered, default), by each pixel's radius (plain), or by "
            "depth, as published (wgld)"),
        row("Engine gaussian", "--focus-band", "gaussian.focus_band", value("N", parse_not_negative),
            "hold radii up to N px sharp (default 0); wgld: the band's share of all depth (default 0.2)"),
        row("Engine gaussian", "--depth-offset", "gaussian.depth_offset", value("N", parse_number),
            "wgld: added to depth of 0 to 1; the default puts the focus into the band"),
        row("Engine gaussian", "--depth-along", "gaussian.depth_along",
            one_of({{"axis", "\"axis\""}, {"ray", "\"ray\""}}),
            "wgld: depth is counted along the axis (default) or along the ray from the pinhole, as "
            "published"),
        row("Engine gaussian", "--depth-band-range", "gaussian.depth_band_range_m",
            value("NEAR,FAR", parse_range_m),
            "wgld: depths that count as 0 and 1, as 0.1m,30m; default: the picture's"),
        row("Engine sprites", "--background", "sprites.background", name<SpriteBackground>(),
            "the engine that draws everything else (default gather)"),
        row("Engine sprites", "--find-points", "sprites.find_points", on_or_off(),
            "of gather too: draw the picture's own bright points each as a whole kernel (default on)"),
        row("Engine sprites", "--bright-factor", "sprites.bright_factor", value("N", parse_positive),
            "of gather too: how many times its surroundings a bright point is (default 3)"),
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

const Json& at_path(const Json& look, const std::string& path) {
    const std::size_t dot = path.find('.');
    return dot == std::string::npos ? look[path] : look[path.substr(0, dot)][path.substr(dot + 1)];
}

}  // namespace

std::string typed_text(const std::string& json) { return typed(Json::parse(json)); }

std::vector<std::string> words_of(const Look& look) {
    const Json now = Json::parse(look_to_json(look)), unset = Json::parse(look_to_json(Look{}));
    std::vector<std::string> words, idle;
    for (const Error& one : check(look).idle) idle.push_back(one.field);
    for (const LookRow& row : look_rows()) {
        const std::string field = row.field;
        const Json &value = at_path(now, field), &other = at_path(unset, field);
        if (value == other) continue;
        // A shift is a mode of its own, said by its flag; what changes nothing would be refused.
        if (field == "lens.focus_mode" && value == "shift") continue;
        if (std::find(idle.begin(), idle.end(), field) != idle.end()) continue;
        if (row.placeholder.empty()) {
            words.push_back(row.flag + std::string(value == true ? "" : "=off"));
            continue;
        }
        words.emplace_back(row.flag);
        words.push_back(row.placeholder == "off|on" ? (value == true ? "on" : "off") : typed(value));
    }
    return words;
}

}  // namespace petzval::cli
