// Zemax lens files: one keyword a line; lines of a surface are indented under SURF n. Surface 0 is the
// object, the last one the image.
#include "lens_files/readers.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace petzval::lens_files {
namespace {

using optics::ApertureKind;
using optics::FieldKind;
using Words = std::vector<std::string_view>;

struct ZmxSurface {
    int line = 0;
    std::string type;
    double curvature = 0, conic = 0, thickness = 0;
    std::optional<double> semi_diameter, clear_aperture;
    std::map<int, double> parameters, extra;  // PARM, XDAT
    std::optional<GlassRequest> glass;
    bool stop = false, tilted = false;
};

const std::set<std::string> kHarmlessInSurface = {"FIMP", "HIDE", "MIRR", "SLAB", "POPS", "MEMA", "COMM",
                                                  "MAZH", "SCOL", "COAT", "SDMA", "BORD", "PZUP", "CZUP",
                                                  "KZUP", "MZUP", "RAED", "RAID", "COFN", "TCMM", "TCE",
                                                  "CHZN", "DRAW", "FTAN", "PPAR", "PARP", "INIS", "NSCC"};
const std::set<std::string> kBendsBeams = {"OBSC", "SQAP", "RCAP", "ELAP", "EAPP", "SPID", "UDAD", "UDOB",
                                           "SQOB", "ELOB", "OBDC", "IGNR", "TILT", "DCNT", "HOLO", "GRIN"};
const std::set<std::string> kSurfaceWords = {"TYPE", "CURV", "DISZ", "GLAS", "CONI", "PARM",
                                             "XDAT", "DIAM", "CLAP", "FLAP", "STOP", "SCBD"};
const std::set<std::string> kHarmlessHeader = {
    "VERS", "PFIL", "LANG", "ENVD",    "GFAC", "GCAT", "RAIM", "PUSH", "SDMA", "OMMA", "ROPD", "HYPR", "PICB",
    "FWGN", "VANN", "POLS", "GLRS",    "GSTD", "NSCD", "COFN", "BLNK", "TOL",  "MNUM", "MOFF", "NOTE", "WWGN",
    "WWGT", "DMFS", "EFFL", "COATING", "FCOM", "AUTH", "PUPD", "RFLN", "XTRA", "ZVAM", "SURF"};

class Reader {
public:
    Result<LensFile> read(const std::string& text);

private:
    Status header(const std::string& keyword, const Words& words, const Line& line);
    Status in_surface(const std::string& keyword, const Words& words, const Line& line);
    Status set_scale(const Words& words, const Line& line);
    Status set_mode(const Words& words, const Line& line);
    Status set_aperture(const std::string& keyword, const Words& words, const Line& line);
    Status glass(const Words& words, const Line& line);
    Status clear_aperture(const Words& words, const Line& line);
    Result<optics::Surface> surface(const ZmxSurface& from);
    Status aspheric_terms(const ZmxSurface& from, optics::Surface& to);
    Status surfaces();
    void wavelengths();
    void field();
    Status finish();

    // Word i as a number; an error that names the line otherwise.
    static Result<double> number(const Words& words, std::size_t i, const Line& line);
    std::vector<double> numbers(const Words& words) const;

    LensFile file_;
    std::vector<ZmxSurface> surfaces_;
    GlassFinder glasses_;
    Ignored ignored_;
    double mm_ = 1;
    bool aperture_by_stop_ = false, has_aperture_ = false, vignetting_factors_ = false, assumed_type_ = false;
    int field_type_ = 0, field_count_ = 0, wavelength_count_ = 0, primary_ = 1;
    std::vector<double> x_fields_, y_fields_, wavelengths_um_;
};

Result<double> Reader::number(const Words& words, std::size_t i, const Line& line) {
    if (i >= words.size())
        return at_line(line.number, std::string(words[0]) + " needs " + std::to_string(i) + " values");
    const auto value = parse_number(words[i]);
    if (!value)
        return at_line(line.number, quoted(words[i]) + " of " + std::string(words[0]) + " is not a number");
    return *value;
}

std::vector<double> Reader::numbers(const Words& words) const {
    std::vector<double> values;
    for (std::size_t i = 1; i < words.size(); ++i)
        if (const auto value = parse_number(words[i])) values.push_back(*value);
    return values;
}

Status Reader::set_scale(const Words& words, const Line& line) {
    const std::string unit = words.size() > 1 ? upper_case(words[1]) : "";
    if (unit == "MM")
        mm_ = 1;
    else if (unit == "CM")
        mm_ = 10;
    else if (unit == "IN")
        mm_ = 25.4;
    else if (unit == "METER")
        mm_ = 1000;
    else
        return at_line(line.number, "UNIT " + quoted(unit) + " is not known; MM, CM, IN and METER are");
    return Done{};
}

Status Reader::set_mode(const Words& words, const Line& line) {
    if (words.size() > 1 && upper_case(words[1]) == "SEQ") return Done{};
    return at_line(line.number, "only sequential lenses (MODE SEQ) are supported");
}

Status Reader::set_aperture(const std::string& keyword, const Words& words, const Line& line) {
    optics::Prescription& lens = file_.lens;
    has_aperture_ = true;
    aperture_by_stop_ = keyword == "FLOA";
    if (aperture_by_stop_) return Done{};
    const auto value = number(words, 1, line);
    if (!value) return value.error();
    const double kind = words.size() > 2 ? parse_number(words[2]).value_or(0) : 0;
    lens.aperture = *value;
    if (keyword == "ENPD") lens.aperture_kind = ApertureKind::EntrancePupilDiameter, lens.aperture *= mm_;
    if (keyword == "FNUM") lens.aperture_kind = ApertureKind::FNumber;
    if (keyword == "OBNA") {
        lens.aperture_kind = ApertureKind::ObjectNA;
        if (kind == 1) lens.aperture = std::sin(*value * 3.14159265358979323846 / 180);  // cone angle
    }
    if (keyword == "FNUM" && kind == 1)
        file_.warnings.push_back("line " + std::to_string(line.number) +
                                 ": the working f-number is read as that for an object at infinity");
    return Done{};
}

Status Reader::header(const std::string& keyword, const Words& words, const Line& line) {
    if (keyword == "UNIT") return set_scale(words, line);
    if (keyword == "MODE") return set_mode(words, line);
    if (keyword == "ENPD" || keyword == "FNUM" || keyword == "OBNA" || keyword == "FLOA")
        return set_aperture(keyword, words, line);
    if (keyword == "NAME") {
        const std::size_t at = line.text.find("NAME");
        if (at != std::string_view::npos) file_.lens.name = std::string(trimmed(line.text.substr(at + 4)));
    } else if (keyword == "FTYP") {
        const auto values = numbers(words);
        if (!values.empty()) field_type_ = int(std::clamp(values[0], -1.0, 9.0));
        if (values.size() > 2) field_count_ = int(std::clamp(values[2], 0.0, 100.0));
        if (values.size() > 3) wavelength_count_ = int(std::clamp(values[3], 0.0, 100.0));
    } else if (keyword == "XFLN" || keyword == "XFLD") {
        x_fields_ = numbers(words);
    } else if (keyword == "YFLN" || keyword == "YFLD") {
        y_fields_ = numbers(words);
    } else if (keyword == "WAVM") {
        const auto value = number(words, 2, line);
        if (!value) return value.error();
        wavelengths_um_.push_back(*value);
    } else if (keyword == "WAVL" || keyword == "WAVN") {
        wavelengths_um_ = numbers(words);
    } else if (keyword == "PWAV") {
        const auto value = number(words, 1, line);
        if (!value) return value.error();
        primary_ = int(std::clamp(*value, 1.0, 100.0));
    } else if (keyword == "VDXN" || keyword == "VDYN" || keyword == "VCXN" || keyword == "VCYN") {
        for (const double value : numbers(words)) vignetting_factors_ = vignetting_factors_ || value != 0;
    } else if (!kHarmlessHeader.contains(keyword)) {
        // Merit functions and options follow the surfaces in endless variety; none of them shapes the lens.
        ignored_.add(keyword.substr(0, 20) + " (line " + std::to_string(line.number) + ")");
    }
    return Done{};
}

Status Reader::glass(const Words& words, const Line& line) {
    GlassRequest request;
    request.line = line.number;
    request.name = words.size() > 1 ? std::string(words[1]) : "";
    if (upper_case(request.name) == "MIRROR") return at_line(line.number, "mirrors are not supported");
    if (request.name.find("___BLANK") != std::string::npos) request.name.clear();
    if (words.size() > 4) request.nd = parse_number(words[4]);
    if (words.size() > 5) request.vd = parse_number(words[5]);
    if (request.name.empty() && !request.nd)
        return at_line(line.number, "GLAS names no glass and gives no index");
    surfaces_.back().glass = request;
    return Done{};
}

Status Reader::clear_aperture(const Words& words, const Line& line) {
    const auto inner = number(words, 1, line), outer = number(words, 2, line);
    if (!inner) return inner.error();
    if (!outer) return outer.error();
    if (*inner != 0) return at_line(line.number, "a clear aperture with a hole in it is not supported");
    if (*outer > 0) surfaces_.back().clear_aperture = *outer;
    return Done{};
}

Status Reader::in_surface(const std::string& keyword, const Words& words, const Line& line) {
    ZmxSurface& surface = surfaces_.back();
    const auto set = [&](double& to, std::size_t i) -> Status {
        const auto value = number(words, i, line);
        if (!value) return value.error();
        to = *value;
        return Done{};
    };
    if (keyword == "STOP")
        surface.stop = true;
    else if (keyword == "TYPE")
        surface.type = words.size() > 1 ? upper_case(words[1]) : "";
    else if (keyword == "CURV")
        return set(surface.curvature, 1);
    else if (keyword == "DISZ")
        return set(surface.thickness, 1);
    else if (keyword == "CONI")
        return set(surface.conic, 1);
    else if (keyword == "GLAS")
        return glass(words, line);
    else if (keyword == "CLAP" || keyword == "FLAP")
        return clear_aperture(words, line);
    else if (keyword == "DIAM")
        return set(surface.semi_diameter.emplace(), 1);
    else if (keyword == "PARM" || keyword == "XDAT") {
        const auto index = number(words, 1, line), value = number(words, 2, line);
        if (!index) return index.error();
        if (!value) return value.error();
        if (!(*index >= 0 && *index <= 500))
            return at_line(line.number, keyword + " has no number " + quoted(words[1]));
        (keyword == "PARM" ? surface.parameters : surface.extra)[int(*index)] = *value;
    } else if (keyword == "SCBD") {
        for (std::size_t i = 2; i < words.size(); ++i)
            surface.tilted = surface.tilted || parse_number(words[i]).value_or(1) != 0;
    } else if (kBendsBeams.contains(keyword)) {
        return at_line(line.number,
                       keyword + " (an aperture or tilt that is not a centred circle) is not supported");
    } else if (kHarmlessInSurface.contains(keyword)) {
        ignored_.add(keyword);
    } else {
        return at_line(line.number, quoted(words[0]) + " of a surface is not understood");
    }
    return Done{};
}

// Coefficients by surface type. PARM i of an even asphere belongs to r^(2i), of an odd one to r^i.
Status Reader::aspheric_terms(const ZmxSurface& from, optics::Surface& to) {
    const bool any = std::any_of(from.parameters.begin(), from.parameters.end(),
                                 [](const auto& p) { return p.second != 0; });
    std::string type = from.type;
    if (type.empty()) {
        assumed_type_ = true;
        type = any ? "EVENASPH" : "STANDARD";
    }
    if (type == "STANDARD") return Done{};
    if (type != "EVENASPH" && type != "ODDASPHE" && type != "XASPHERE")
        return at_line(from.line, "surface type " + quoted(type) +
                                      " is not supported; STANDARD, EVENASPH, ODDASPHE and XASPHERE are");
    const auto add = [&](int power, double coefficient) {
        if (coefficient != 0) to.asphere.push_back({power, coefficient * std::pow(mm_, 1 - power)});
    };
    for (const auto& [i, value] : from.parameters) {
        const int power = type == "ODDASPHE" ? i : 2 * i;
        if (value != 0 && (power < 1 || i > 12))
            return at_line(from.line, "PARM " + std::to_string(i) + " of an asphere has no meaning");
        add(power, value);
    }
    if (type != "XASPHERE" || from.extra.empty()) return Done{};
    const auto norm = from.extra.find(2);
    if (norm == from.extra.end() || !(norm->second > 0))
        return at_line(from.line, "XASPHERE needs a normalisation radius (XDAT 2)");
    for (const auto& [i, value] : from.extra) {
        const int power = 2 * (i - 2);
        if (i < 3 || value == 0) continue;
        if (power > optics::kHighestAspherePower)
            return at_line(from.line, "powers of r above " + std::to_string(optics::kHighestAspherePower) +
                                          " are not supported");
        add(power, value / std::pow(norm->second, power));
    }
    return Done{};
}

Result<optics::Surface> Reader::surface(const ZmxSurface& from) {
    optics::Surface to;
    if (from.tilted) return at_line(from.line, "a tilted or decentred surface (SCBD) is not supported");
    if (!std::isfinite(from.thickness)) return at_line(from.line, "DISZ of this surface must be finite");
    to.curvature_per_mm = from.curvature / mm_;
    to.conic = from.conic;
    to.thickness_mm = from.thickness * mm_;
    const double radius = from.clear_aperture.value_or(from.semi_diameter.value_or(0)) * mm_;
    if (radius > 0) to.clear_radius_mm = radius;
    if (const Status status = aspheric_terms(from, to); !status) return status.error();
    if (from.glass) {
        const auto glass = glasses_.find(*from.glass);
        if (!glass) return glass.error();
        to.after = *glass;
    }
    return to;
}

Status Reader::surfaces() {
    optics::Prescription& lens = file_.lens;
    if (surfaces_.size() < 3) return at_line(1, "object, image and at least one surface (SURF) are needed");
    const ZmxSurface &object = surfaces_.front(), &image = surfaces_.back();
    if (std::isfinite(object.thickness) && object.thickness < 1e9)
        lens.object_distance_mm = object.thickness * mm_;
    if (object.glass) return at_line(object.glass->line, "an object inside glass is not supported");
    if (image.curvature != 0)
        file_.warnings.push_back("the image surface is curved; the sensor is taken as flat");
    bool has_stop = false;
    for (std::size_t i = 1; i + 1 < surfaces_.size(); ++i) {
        auto converted = surface(surfaces_[i]);
        if (!converted) return converted.error();
        lens.surfaces.push_back(std::move(*converted));
        if (surfaces_[i].stop && has_stop)
            return at_line(surfaces_[i].line, "a second surface is marked STOP");
        if (surfaces_[i].stop) lens.stop = int(i) - 1, has_stop = true;
    }
    if (!has_stop) file_.warnings.push_back("no surface is marked STOP; the first is taken");
    return Done{};
}

// The first wavelength_count_ of the list are in use; the rest are fillers.
void Reader::wavelengths() {
    optics::Prescription& lens = file_.lens;
    auto& used = wavelengths_um_;
    if (wavelength_count_ > 0 && std::size_t(wavelength_count_) < used.size())
        used.resize(std::size_t(wavelength_count_));
    if (used.empty()) return;
    lens.primary_um = used[std::min(std::size_t(primary_), used.size()) - 1];
    const auto [shortest, longest] = std::minmax_element(used.begin(), used.end());
    if (*shortest < *longest) {
        lens.short_um = *shortest;
        lens.long_um = *longest;
    } else {
        file_.warnings.push_back("the file has one wavelength; colour is taken between the F and C lines");
    }
}

void Reader::field() {
    optics::Prescription& lens = file_.lens;
    const std::size_t count = std::max(x_fields_.size(), y_fields_.size());
    for (std::size_t i = 0; i < count && (field_count_ == 0 || i < std::size_t(field_count_)); ++i) {
        const double x = i < x_fields_.size() ? x_fields_[i] : 0, y = i < y_fields_.size() ? y_fields_[i] : 0;
        lens.field = std::max(lens.field, std::hypot(x, y));
    }
    if (field_type_ == 1) lens.field_kind = FieldKind::ObjectHeight, lens.field *= mm_;
    if (field_type_ == 2 || field_type_ == 3) lens.field_kind = FieldKind::ImageHeight, lens.field *= mm_;
    if (field_type_ == 3 && lens.field > 0)
        file_.warnings.push_back(
            "the field is a real image height; the paraxial height of that size is used");
    if (vignetting_factors_)
        file_.warnings.push_back("vignetting factors are not used; the clear apertures vignette");
}

Status Reader::finish() {
    optics::Prescription& lens = file_.lens;
    if (const Status status = surfaces(); !status) return status.error();
    wavelengths();
    field();
    if (!has_aperture_) aperture_by_stop_ = true;
    if (aperture_by_stop_) {
        lens.aperture_kind = ApertureKind::StopRadius;
        lens.aperture = lens.surfaces[std::size_t(lens.stop)].clear_radius_mm;
        if (!std::isfinite(lens.aperture))
            return at_line(surfaces_[std::size_t(lens.stop) + 1].line,
                           "the stop has no diameter (DIAM), and no aperture "
                           "is given otherwise");
    }
    if (assumed_type_)
        file_.warnings.push_back("surfaces without TYPE are read as STANDARD, or as EVENASPH with PARM");
    glasses_.report(file_.warnings);
    warn_of_models(file_);
    assume_field(file_);
    ignored_.report(file_.warnings);
    return Done{};
}

Result<LensFile> Reader::read(const std::string& text) {
    file_.format = "Zemax .zmx";
    for (const Line& line : split_lines(text)) {
        const Words words = split_words(line.text);
        if (words.empty()) continue;
        const std::string keyword = upper_case(words[0]);
        Status status = Done{};
        if (keyword == "SURF") {
            if (surfaces_.size() > std::size_t(optics::kMostSurfaces))
                return at_line(line.number,
                               "more than " + std::to_string(optics::kMostSurfaces) + " surfaces");
            const auto index = number(words, 1, line);
            if (!index) return index.error();
            if (*index != double(surfaces_.size()))
                return at_line(line.number, "SURF " + std::to_string(surfaces_.size()) + " is expected here");
            surfaces_.push_back({});
            surfaces_.back().line = line.number;
        } else if (!surfaces_.empty() && (line.indented || kSurfaceWords.contains(keyword))) {
            status = in_surface(keyword, words, line);
        } else {
            status = header(keyword, words, line);
        }
        if (!status) return status.error();
    }
    if (const Status status = finish(); !status) return status.error();
    return std::move(file_);
}

}  // namespace

Result<LensFile> read_zmx(const std::string& text) { return Reader().read(text); }

}  // namespace petzval::lens_files
