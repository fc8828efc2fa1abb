// Our own lens format: one entry of a lens list saved alone.
#include "lens_files/glass_catalogue.h"
#include "lens_files/readers.h"

#include <cmath>
#include <limits>

namespace petzval::lens_files {
namespace {

using optics::ApertureKind;
using optics::FieldKind;
using optics::Surface;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Members that describe a lens without shaping the path of light.
const std::set<std::string> kDescriptive = {"expected",
                                            "recomputed",
                                            "also",
                                            "names",
                                            "dispersion_known",
                                            "semi_aperture_note",
                                            "published_image_distance",
                                            "about",
                                            "conventions",
                                            "numbers_only",
                                            "glasses"};
const std::set<std::string> kSurfaceRemarks = {"semi_aperture_origin", "comment", "note", "name", "label"};

class Reader {
public:
    Result<LensFile> read(const Json& root);

private:
    using Check = Status;

    Check top_level(const Json& root);
    void printed(const Json& check);
    Check texts(const Json& root);
    Check scale(const Json& value);
    Check object(const Json& value);
    Check aperture(const Json& value);
    Check field(const std::string& key, const Json& value);
    Check wavelengths(const Json& value);
    Check surfaces(const Json& list);
    Check surface(const Json& json, Surface& out, int index);
    Check surface_member(const std::string& key, const Json& value, Surface& out, int index);
    Check stop(const Json& value, int index);
    Check surface_number(const std::string& key, const Json& value, Surface& out) const;
    Check radius(const Json& value, double& per_mm) const;
    Check asphere(const std::string& key, const Json& value, Surface& out) const;
    Check medium(const Json& value, Surface& out);
    Check finish(const Json& root);

    LensFile file_;
    GlassFinder glasses_;
    Ignored ignored_;
    bool has_stop_ = false, has_aperture_ = false;
    double mm_ = 1;  // millimetres per unit of the file
    double object_height_mm_ = 0;
};

Result<double> number(const Json& value, const std::string& what) {
    if (!value.is(Json::Type::Number)) return at_line(value.line, what + " must be a number");
    return value.number;
}

bool is_infinite_word(const Json& value) {
    return value.is(Json::Type::String) && std::isinf(parse_number(value.string).value_or(0));
}

// A published focal length or f-number among the "expected" values.
void Reader::printed(const Json& check) {
    const Json *quantity = check.find("quantity"), *value = check.find("value");
    if (!quantity || !value || !value->is(Json::Type::Number)) return;
    if (quantity->string == "EFL") file_.printed_focal_length_mm = value->number;
    if (quantity->string == "f_number") file_.printed_f_number = value->number;
}

Status Reader::texts(const Json& root) {
    optics::Prescription& lens = file_.lens;
    for (const auto& [key, to] : {std::pair<const char*, std::string*>{"id", &lens.id},
                                  {"name", &lens.name},
                                  {"class", &lens.kind},
                                  {"source", &lens.source},
                                  {"year", &lens.year},
                                  {"history", &lens.history}}) {
        const Json* value = root.find(key);
        if (!value || value->is(Json::Type::Null)) continue;
        if (!value->is(Json::Type::String)) return at_line(value->line, quoted(key) + " must be text");
        *to = value->string;
    }
    if (const Json* names = root.find("names"))
        for (const Json& name : names->items) lens.names.push_back(name.string);
    if (const Json* expected = root.find("expected"))
        for (const Json& check : expected->items) printed(check);
    if (const Json* notes = root.find("notes"))
        for (const Json& note : notes->items) lens.notes.push_back(note.string);
    return Done{};
}

Status Reader::scale(const Json& value) {
    const std::string unit = upper_case(value.string);
    if (unit == "MM" || unit.empty()) return Done{};
    if (unit == "CM")
        mm_ = 10;
    else if (unit == "M")
        mm_ = 1000;
    else if (unit == "IN" || unit == "INCH" || unit == "INCHES")
        mm_ = 25.4;
    else
        file_.warnings.push_back("line " + std::to_string(value.line) + ": units " + quoted(value.string) +
                                 " are read as mm");
    return Done{};
}

// "infinity", a number, or {"distance": number, "height": number}: in front of the first vertex.
Status Reader::object(const Json& value) {
    double& distance = file_.lens.object_distance_mm;
    for (const char* key : {"height", "height_mm"})
        if (const Json* height = value.find(key)) object_height_mm_ = std::abs(height->number) * mm_;
    const Json* number = &value;
    if (value.is(Json::Type::Null) || is_infinite_word(value)) return Done{};
    for (const char* key : {"distance", "distance_mm", "object_distance"})
        if (const Json* inside = value.find(key)) number = inside;
    if (is_infinite_word(*number)) return Done{};
    if (!number->is(Json::Type::Number))
        return at_line(value.line,
                       "\"object\" must be \"infinity\" or a distance in front of the first surface");
    distance = std::abs(number->number) * mm_;
    if (distance >= 1e10) distance = kInfinity;
    return Done{};
}

Status Reader::aperture(const Json& value) {
    const Json *type = value.find("type"), *size = value.find("value");
    if (!type || !size || !size->is(Json::Type::Number))
        return at_line(value.line, "\"aperture\" needs a type and a number as value");
    optics::Prescription& lens = file_.lens;
    const std::string kind = upper_case(type->string);
    lens.aperture = size->number;
    has_aperture_ = true;
    if (kind == "F_NUMBER") {
        lens.aperture_kind = ApertureKind::FNumber;
    } else if (kind == "EPD") {
        lens.aperture_kind = ApertureKind::EntrancePupilDiameter;
        lens.aperture *= mm_;
    } else if (kind == "STOP_SEMI_APERTURE") {
        lens.aperture_kind = ApertureKind::StopRadius;
        lens.aperture *= mm_;
    } else if (kind == "OBJECT_NA") {
        lens.aperture_kind = ApertureKind::ObjectNA;
    } else {
        return at_line(type->line, "aperture type " + quoted(type->string) +
                                       " is not known; EPD, F_NUMBER, STOP_SEMI_APERTURE and OBJECT_NA are");
    }
    return Done{};
}

Status Reader::field(const std::string& key, const Json& value) {
    if (value.is(Json::Type::Null)) return Done{};
    const auto size = number(value, quoted(key));
    if (!size) return size.error();
    optics::Prescription& lens = file_.lens;
    if (key == "field_used_for_traces_deg") {
        lens.paraxial_field_deg = *size;
        return Done{};
    }
    if (key == "sensor_width_mm") {
        if (!(*size > 0)) return at_line(value.line, quoted(key) + " must be above 0");
        lens.sensor_width_mm = *size;
        return Done{};
    }
    lens.field = key == "max_field_deg" ? *size : *size * mm_;
    lens.field_kind = key == "max_field_deg"       ? FieldKind::AngleDeg
                      : key == "max_object_height" ? FieldKind::ObjectHeight
                                                   : FieldKind::ImageHeight;
    return Done{};
}

Status Reader::wavelengths(const Json& value) {
    optics::Prescription& lens = file_.lens;
    for (const auto& [key, line] : value.members) {
        const auto um = number(line, "wavelength " + quoted(key));
        if (!um) return um.error();
        if (key == "short")
            lens.short_um = *um;
        else if (key == "primary")
            lens.primary_um = *um;
        else if (key == "long")
            lens.long_um = *um;
        else
            file_.warnings.emplace_back("wavelength " + quoted(key) +
                                        " is ignored: short, primary and long are used");
    }
    if (!value.is(Json::Type::Object))
        return at_line(value.line, "\"wavelengths_um\" must hold short, primary and long");
    if (!(lens.short_um <= lens.primary_um && lens.primary_um <= lens.long_um))
        return at_line(value.line, "\"wavelengths_um\" must rise from short over primary to long");
    return Done{};
}

Status Reader::radius(const Json& value, double& per_mm) const {
    if (value.is(Json::Type::Null) || is_infinite_word(value)) return Done{};
    const auto size = number(value, "radius (null is a plane)");
    if (!size) return size.error();
    if (*size == 0) return at_line(value.line, "a radius of 0 is not a surface; null is a plane");
    per_mm = 1 / (*size * mm_);
    return Done{};
}

// {"4": a, …} or {"A4": a, …}: coefficients of powers of r.
Status Reader::asphere(const std::string& key, const Json& value, Surface& out) const {
    if (value.is(Json::Type::Null)) return Done{};
    if (!value.is(Json::Type::Object)) return at_line(value.line, quoted(key) + " must be an object");
    for (const auto& [power_text, coefficient] : value.members) {
        const std::size_t digits = power_text.find_first_not_of("AaRr^");
        const auto power = parse_number(digits == std::string::npos ? "" : power_text.substr(digits));
        const auto size = number(coefficient, "asphere coefficient " + quoted(power_text));
        if (!size) return size.error();
        if (!power || *power != std::floor(*power) ||
            !(*power >= 1 && *power <= optics::kHighestAspherePower))
            return at_line(coefficient.line, "power " + quoted(power_text) + " of an asphere must be 1 to " +
                                                 std::to_string(optics::kHighestAspherePower));
        out.asphere.push_back({int(*power), *size * std::pow(mm_, 1 - *power)});
    }
    return Done{};
}

Status Reader::medium(const Json& value, Surface& out) {
    GlassRequest request;
    request.line = value.line;
    if (value.is(Json::Type::Null)) return Done{};
    if (value.is(Json::Type::String)) request.name = value.string;
    for (const auto& [key, member] : value.members) {
        if (key == "glass" && member.is(Json::Type::String))
            request.name = member.string;
        else if (key == "maker" && member.is(Json::Type::String))
            request.maker = member.string;
        else if ((key == "nd" || key == "n") && member.is(Json::Type::Number))
            request.nd = member.number;
        else if ((key == "Vd" || key == "vd") && member.is(Json::Type::Number))
            request.vd = member.number;
        else if (!member.is(Json::Type::Null) && !member.is(Json::Type::String))
            return at_line(member.line, quoted(key) + " of a medium is not understood");
    }
    if (upper_case(request.name) == "AIR") return Done{};
    if (upper_case(request.name) == "MIRROR") return at_line(value.line, "mirrors are not supported");
    if (request.name.empty() && !request.nd)
        return at_line(value.line, "a medium is \"air\", {\"glass\": name} or {\"nd\", \"Vd\"}");
    const auto glass = glasses_.find(request);
    if (!glass) return glass.error();
    out.after = *glass;
    return Done{};
}

Status Reader::stop(const Json& value, int index) {
    if (!value.is(Json::Type::Bool)) return at_line(value.line, "\"stop\" must be true or false");
    if (!value.boolean) return Done{};
    if (has_stop_) return at_line(value.line, "a second surface is marked as the stop");
    file_.lens.stop = index;
    has_stop_ = true;
    return Done{};
}

// Numbers that may be left out by null.
Status Reader::surface_number(const std::string& key, const Json& value, Surface& out) const {
    if (value.is(Json::Type::Null)) return Done{};
    const auto size = number(value, quoted(key));
    if (!size) return size.error();
    if (key == "thickness") out.thickness_mm = *size * mm_;
    if (key == "conic") out.conic = *size;
    if (key == "semi_aperture") out.clear_radius_mm = *size * mm_;
    return Done{};
}

Status Reader::surface_member(const std::string& key, const Json& value, Surface& out, int index) {
    if (key == "radius") return radius(value, out.curvature_per_mm);
    if (key == "cylinder_radius") return radius(value, out.cylinder_per_mm);
    if (key == "medium") return medium(value, out);
    if (key == "asphere_power" || key == "asphere_even") return asphere(key, value, out);
    if (key == "stop") return stop(value, index);
    if (key == "thickness" || key == "conic" || key == "semi_aperture")
        return surface_number(key, value, out);
    if (kSurfaceRemarks.contains(key)) return Done{};
    const bool shapes_light =
        value.is(Json::Type::Number) || value.is(Json::Type::Array) || value.is(Json::Type::Object);
    if (shapes_light) return at_line(value.line, quoted(key) + " of a surface is not understood");
    ignored_.add(key);
    return Done{};
}

Status Reader::surface(const Json& json, Surface& out, int index) {
    if (!json.is(Json::Type::Object)) return at_line(json.line, "a surface must be an object");
    for (const char* key : {"radius", "thickness"})
        if (!json.find(key))
            return at_line(json.line, "surface " + std::to_string(index + 1) + " has no " + key);
    for (const auto& [key, value] : json.members)
        if (const Status status = surface_member(key, value, out, index); !status) return status.error();
    return Done{};
}

Status Reader::surfaces(const Json& list) {
    if (!list.is(Json::Type::Array) || list.items.empty())
        return at_line(list.line, "\"surfaces\" must be a list of surfaces");
    if (list.items.size() > std::size_t(optics::kMostSurfaces))
        return at_line(list.line, "more than " + std::to_string(optics::kMostSurfaces) + " surfaces");
    for (std::size_t i = 0; i < list.items.size(); ++i) {
        Surface out;
        if (const Status status = surface(list.items[i], out, int(i)); !status) return status.error();
        file_.lens.surfaces.push_back(std::move(out));
    }
    return Done{};
}

Status Reader::top_level(const Json& root) {
    for (const auto& [key, value] : root.members) {
        Status status = Done{};
        if (key == "object" || key == "object_distance" || key == "object_distance_mm")
            status = object(value);
        else if (key == "aperture")
            status = aperture(value);
        else if (key == "max_field_deg" || key == "field_used_for_traces_deg" || key == "max_object_height" ||
                 key == "max_image_height" || key == "sensor_width_mm")
            status = field(key, value);
        else if (key == "wavelengths_um")
            status = wavelengths(value);
        else if (key == "surfaces")
            status = surfaces(value);
        else if (!kDescriptive.contains(key) && key != "units" && key != "id" && key != "name" &&
                 key != "class" && key != "source" && key != "year" && key != "history" && key != "notes")
            ignored_.add(key);
        if (!status) return status.error();
    }
    return Done{};
}

Status Reader::finish(const Json& root) {
    optics::Prescription& lens = file_.lens;
    if (lens.surfaces.empty()) {
        const Json* several = root.find("lenses");
        return at_line(root.line, several
                                      ? "this is a list of " + std::to_string(several->items.size()) +
                                            " lenses; save one entry alone"
                                      : "there are neither \"surfaces\" nor \"curves\": this is not a lens");
    }
    if (!has_stop_) {
        lens.stop = 0;
        file_.warnings.emplace_back("no surface is marked as the stop; the first is taken");
    }
    if (!has_aperture_) {
        lens.aperture_kind = ApertureKind::StopRadius;
        lens.aperture = lens.surfaces[std::size_t(lens.stop)].clear_radius_mm;
        if (std::isinf(lens.aperture))
            return at_line(root.line,
                           "the lens has neither an \"aperture\" nor a \"semi_aperture\" at the stop");
        file_.warnings.emplace_back("no aperture is given; the stop's clear radius is taken");
    }
    if (lens.field == 0 && object_height_mm_ > 0) {
        lens.field_kind = FieldKind::ObjectHeight;
        lens.field = object_height_mm_;
    }
    bool any_rim = false;
    for (const Surface& surface : lens.surfaces) any_rim = any_rim || std::isfinite(surface.clear_radius_mm);
    if (!any_rim) file_.warnings.emplace_back("no clear apertures are given: the lens vignettes nothing");
    glasses_.report(file_.warnings);
    warn_of_models(file_);
    ignored_.report(file_.warnings);
    return Done{};
}

Result<LensFile> Reader::read(const Json& root) {
    file_.format = "petzval JSON";
    if (!root.is(Json::Type::Object)) return at_line(root.line, "a lens file holds one JSON object");
    if (root.find("curves")) {
        if (const Status status = texts(root); !status) return status.error();
        auto curves = read_json_curves(root);
        if (!curves) return curves.error();
        curves->lens = std::move(file_.lens);
        return curves;
    }
    if (const Json* units = root.find("units"))
        if (const Status status = scale(*units); !status) return status.error();
    if (const Json* glasses = root.find("glasses")) {
        auto own = read_glasses(*glasses);
        if (!own) return own.error();
        glasses_ = GlassFinder(std::move(*own));
    }
    for (const Status& status : {texts(root), top_level(root), finish(root)})
        if (!status) return status.error();
    return std::move(file_);
}

}  // namespace

Result<LensFile> read_json_lens(const std::string& text) {
    const auto root = parse_json(text);
    if (!root) return root.error();
    return read_json_lens(*root);
}

Result<LensFile> read_json_lens(const Json& root) { return Reader().read(root); }

}  // namespace petzval::lens_files
