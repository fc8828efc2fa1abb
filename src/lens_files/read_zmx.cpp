// Zemax lens files: one keyword a line; lines of a surface are indented under SURF n. Surface 0 is the
// object, the last one the image.
#include "lens_files/readers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

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
    bool stop = false, tilted = false, has_thickness = false;
};

const std::set<std::string> kHarmlessInSurface = {"FIMP", "HIDE", "MIRR", "SLAB", "POPS",
                                                  "MEMA", "COMM", "MAZH", "SCOL", "COAT",
                                                  "PZUP", "CZUP", "KZUP", "MZUP", "CHZN"};
const std::set<std::string> kBendsBeams = {"OBSC", "SQAP", "RCAP", "ELAP", "EAPP", "SPID", "UDAD", "UDOB",
                                           "SQOB", "ELOB", "OBDC", "IGNR", "TILT", "DCNT", "HOLO", "GRIN"};
const std::set<std::string> kHarmlessHeader = {
    "VERS", "PFIL", "LANG", "ENVD", "GFAC",    "GCAT", "RAIM", "PUSH", "SDMA", "OMMA", "ROPD", "HYPR",
    "PICB", "FWGN", "VANN", "POLS", "GLRS",    "GSTD", "NSCD", "COFN", "BLNK", "TOL",  "MOFF", "NOTE",
    "WWGN", "WWGT", "DMFS", "EFFL", "COATING", "FCOM", "AUTH", "PUPD", "RFLN", "XTRA", "ZVAM", "SURF"};

class Reader {
public:
    Result<LensFile> read(const std::string& text);

private:
    // Handler of a keyword; words[0] is the keyword.
    using Handler = Status (*)(Reader& reader, const Words& words, const Line& line);
    template <auto member>
    static Status call(Reader& reader, const Words& words, const Line& line) {
        return (reader.*member)(words, line);
    }
    // The keyword's first number into a member of the current surface; number i of a list into its list.
    template <auto member>
    static Status put(Reader& reader, const Words& words, const Line& line) {
        return set(reader.surfaces_.back().*member, words, 1, line);
    }
    template <auto member>
    static Status put_indexed(Reader& reader, const Words& words, const Line& line) {
        return set_indexed(reader.surfaces_.back().*member, words, line);
    }
    static const std::map<std::string, Handler>& header_words();
    static const std::map<std::string, Handler>& surface_words();
    Status header(const std::string& keyword, const Words& words, const Line& line);
    Status in_surface(const std::string& keyword, const Words& words, const Line& line);

    Status unit(const Words& words, const Line& line);
    Status name(const Words& words, const Line& line);
    Status entrance_pupil(const Words& words, const Line& line);
    Status f_number(const Words& words, const Line& line);
    Status object_na(const Words& words, const Line& line);
    Status field_type(const Words& words, const Line& line);
    Status vignetting(const Words& words, const Line& line);
    Status primary(const Words& words, const Line& line);
    Status configurations(const Words& words, const Line& line);

    Status glass(const Words& words, const Line& line);
    Status clear_aperture(const Words& words, const Line& line);
    Status tilt(const Words& words, const Line& line);

    Result<optics::Surface> surface(const ZmxSurface& from);
    Status aspheric_terms(const ZmxSurface& from, optics::Surface& to);
    Status surfaces();
    void set_wavelengths();
    void set_field();
    Status set_aperture();
    Status finish();

    // Word i as a number; an error that names the line otherwise.
    static Result<double> number(const Words& words, std::size_t i, const Line& line);
    static Status set(double& to, const Words& words, std::size_t i, const Line& line);
    static Status set_indexed(std::map<int, double>& to, const Words& words, const Line& line);
    static std::vector<double> numbers(const Words& words);

    LensFile file_;
    std::vector<ZmxSurface> surfaces_;
    GlassFinder glasses_;
    Ignored ignored_;
    double mm_ = 1;
    std::optional<ApertureKind> aperture_;  // none: the stop's diameter rules
    bool vignetting_factors_ = false, assumed_type_ = false, several_configurations_ = false;
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

std::vector<double> Reader::numbers(const Words& words) {
    std::vector<double> values;
    for (std::size_t i = 1; i < words.size(); ++i)
        if (const auto value = parse_number(words[i])) values.push_back(*value);
    return values;
}

Status Reader::set(double& to, const Words& words, std::size_t i, const Line& line) {
    const auto value = number(words, i, line);
    if (!value) return value.error();
    to = *value;
    return Done{};
}

Status Reader::set_indexed(std::map<int, double>& to, const Words& words, const Line& line) {
    const auto index = number(words, 1, line), value = number(words, 2, line);
    if (!index) return index.error();
    if (!value) return value.error();
    if (!(*index >= 0 && *index <= 500))
        return at_line(line.number, std::string(words[0]) + " has no number " + quoted(words[1]));
    to[int(*index)] = *value;
    return Done{};
}

// The lens as a whole.

Status Reader::unit(const Words& words, const Line& line) {
    const std::map<std::string, double> known = {{"MM", 1}, {"CM", 10}, {"IN", 25.4}, {"METER", 1000}};
    const auto found = known.find(words.size() > 1 ? upper_case(words[1]) : "");
    if (found == known.end()) return at_line(line.number, "UNIT is not known; MM, CM, IN and METER are");
    mm_ = found->second;
    return Done{};
}

Status Reader::name(const Words&, const Line& line) {
    file_.lens.name = std::string(trimmed(trimmed(line.text).substr(4)));
    return Done{};
}

Status Reader::entrance_pupil(const Words& words, const Line& line) {
    aperture_ = ApertureKind::EntrancePupilDiameter;
    return set(file_.lens.aperture, words, 1, line);
}

Status Reader::f_number(const Words& words, const Line& line) {
    aperture_ = ApertureKind::FNumber;
    if (words.size() > 2 && parse_number(words[2]) == 1.0)
        file_.warnings.push_back("line " + std::to_string(line.number) +
                                 ": the working f-number is read as that for an object at infinity");
    return set(file_.lens.aperture, words, 1, line);
}

Status Reader::object_na(const Words& words, const Line& line) {
    aperture_ = ApertureKind::ObjectNA;
    if (const Status status = set(file_.lens.aperture, words, 1, line); !status) return status.error();
    const bool cone_angle = words.size() > 2 && parse_number(words[2]) == 1.0;  // in degrees
    if (cone_angle) file_.lens.aperture = std::sin(file_.lens.aperture * std::numbers::pi / 180);
    return Done{};
}

Status Reader::field_type(const Words& words, const Line&) {
    const auto values = numbers(words);
    if (!values.empty()) field_type_ = int(std::clamp(values[0], -1.0, 9.0));
    if (values.size() > 2) field_count_ = int(std::clamp(values[2], 0.0, 100.0));
    if (values.size() > 3) wavelength_count_ = int(std::clamp(values[3], 0.0, 100.0));
    return Done{};
}

Status Reader::vignetting(const Words& words, const Line&) {
    for (const double value : numbers(words)) vignetting_factors_ = vignetting_factors_ || value != 0;
    return Done{};
}

Status Reader::primary(const Words& words, const Line& line) {
    const auto value = number(words, 1, line);
    if (!value) return value.error();
    primary_ = int(std::clamp(*value, 1.0, 100.0));
    return Done{};
}

// Values of each configuration follow; those of the current one are in the surfaces.
Status Reader::configurations(const Words& words, const Line& line) {
    const auto count = number(words, 1, line);
    if (!count) return count.error();
    if (several_configurations_ = *count > 1; !several_configurations_) return Done{};
    file_.warnings.push_back("line " + std::to_string(line.number) +
                             ": a zoom or one of several configurations, as its surfaces were saved");
    return Done{};
}

const std::map<std::string, Reader::Handler>& Reader::header_words() {
    static const auto mode = [](Reader&, const Words& w, const Line& l) -> Status {
        if (w.size() > 1 && upper_case(w[1]) == "SEQ") return Done{};
        return at_line(l.number, "only sequential lenses (MODE SEQ) are supported");
    };
    static const auto x_fields = [](Reader& r, const Words& w, const Line&) -> Status {
        r.x_fields_ = numbers(w);
        return Done{};
    };
    static const auto y_fields = [](Reader& r, const Words& w, const Line&) -> Status {
        r.y_fields_ = numbers(w);
        return Done{};
    };
    static const auto list = [](Reader& r, const Words& w, const Line&) -> Status {
        r.wavelengths_um_ = numbers(w);
        return Done{};
    };
    static const auto one = [](Reader& r, const Words& w, const Line& l) -> Status {
        return set(r.wavelengths_um_.emplace_back(), w, 2, l);
    };
    static const auto by_stop = [](Reader& r, const Words&, const Line&) -> Status {
        r.aperture_.reset();
        return Done{};
    };
    static const std::map<std::string, Handler> words = {{"UNIT", call<&Reader::unit>},
                                                         {"MODE", mode},
                                                         {"NAME", call<&Reader::name>},
                                                         {"ENPD", call<&Reader::entrance_pupil>},
                                                         {"FNUM", call<&Reader::f_number>},
                                                         {"OBNA", call<&Reader::object_na>},
                                                         {"FLOA", by_stop},
                                                         {"FTYP", call<&Reader::field_type>},
                                                         {"XFLN", x_fields},
                                                         {"XFLD", x_fields},
                                                         {"YFLN", y_fields},
                                                         {"YFLD", y_fields},
                                                         {"VDXN", call<&Reader::vignetting>},
                                                         {"VDYN", call<&Reader::vignetting>},
                                                         {"VCXN", call<&Reader::vignetting>},
                                                         {"VCYN", call<&Reader::vignetting>},
                                                         {"WAVM", one},
                                                         {"WAVL", list},
                                                         {"WAVN", list},
                                                         {"PWAV", call<&Reader::primary>},
                                                         {"MNUM", call<&Reader::configurations>}};
    return words;
}

Status Reader::header(const std::string& keyword, const Words& words, const Line& line) {
    if (const auto found = header_words().find(keyword); found != header_words().end())
        return found->second(*this, words, line);
    // Merit functions and options follow the surfaces in endless variety; none of them shapes the lens.
    if (!kHarmlessHeader.contains(keyword) && !several_configurations_)
        ignored_.add(keyword.substr(0, 20) + " (line " + std::to_string(line.number) + ")");
    return Done{};
}

// One surface.

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

Status Reader::tilt(const Words& words, const Line&) {
    for (std::size_t i = 2; i < words.size(); ++i)
        surfaces_.back().tilted = surfaces_.back().tilted || parse_number(words[i]).value_or(1) != 0;
    return Done{};
}

const std::map<std::string, Reader::Handler>& Reader::surface_words() {
    static const auto stop = [](Reader& r, const Words&, const Line&) -> Status {
        r.surfaces_.back().stop = true;
        return Done{};
    };
    static const auto type = [](Reader& r, const Words& w, const Line&) -> Status {
        r.surfaces_.back().type = w.size() > 1 ? upper_case(w[1]) : "";
        return Done{};
    };
    static const auto semi_diameter = [](Reader& r, const Words& w, const Line& l) -> Status {
        return set(r.surfaces_.back().semi_diameter.emplace(), w, 1, l);
    };
    static const auto thickness = [](Reader& r, const Words& w, const Line& l) {
        r.surfaces_.back().has_thickness = true;
        return set(r.surfaces_.back().thickness, w, 1, l);
    };
    static const std::map<std::string, Handler> words = {{"STOP", stop},
                                                         {"TYPE", type},
                                                         {"DIAM", semi_diameter},
                                                         {"CURV", put<&ZmxSurface::curvature>},
                                                         {"DISZ", thickness},
                                                         {"CONI", put<&ZmxSurface::conic>},
                                                         {"PARM", put_indexed<&ZmxSurface::parameters>},
                                                         {"XDAT", put_indexed<&ZmxSurface::extra>},
                                                         {"GLAS", call<&Reader::glass>},
                                                         {"CLAP", call<&Reader::clear_aperture>},
                                                         {"FLAP", call<&Reader::clear_aperture>},
                                                         {"SCBD", call<&Reader::tilt>}};
    return words;
}

Status Reader::in_surface(const std::string& keyword, const Words& words, const Line& line) {
    if (const auto found = surface_words().find(keyword); found != surface_words().end())
        return found->second(*this, words, line);
    if (kBendsBeams.contains(keyword))
        return at_line(line.number,
                       keyword + " (not a centred circular aperture, or a tilt) is not supported");
    if (!kHarmlessInSurface.contains(keyword))
        return at_line(line.number, quoted(words[0]) + " of a surface is not understood");
    ignored_.add(keyword);
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
    if (image.glass || (image.curvature != 0 && !image.has_thickness))
        return at_line(image.line, "the file ends with a surface of a lens, not with an image");
    if (image.curvature != 0)
        file_.warnings.emplace_back("the image surface is curved; the sensor is taken as flat");
    bool has_stop = false;
    for (std::size_t i = 1; i + 1 < surfaces_.size(); ++i) {
        auto converted = surface(surfaces_[i]);
        if (!converted) return converted.error();
        lens.surfaces.push_back(std::move(*converted));
        if (surfaces_[i].stop && has_stop)
            return at_line(surfaces_[i].line, "a second surface is marked STOP");
        if (surfaces_[i].stop) lens.stop = int(i) - 1, has_stop = true;
    }
    if (!has_stop) file_.warnings.emplace_back("no surface is marked STOP; the first is taken");
    return Done{};
}

// The first wavelength_count_ of the list are in use; the rest are fillers.
void Reader::set_wavelengths() {
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
        file_.warnings.emplace_back("the file has one wavelength; colour is taken between the F and C lines");
    }
}

void Reader::set_field() {
    optics::Prescription& lens = file_.lens;
    const std::size_t count = std::max(x_fields_.size(), y_fields_.size());
    for (std::size_t i = 0; i < count && (field_count_ == 0 || i < std::size_t(field_count_)); ++i) {
        const double x = i < x_fields_.size() ? x_fields_[i] : 0, y = i < y_fields_.size() ? y_fields_[i] : 0;
        lens.field = std::max(lens.field, std::hypot(x, y));
    }
    if (field_type_ == 1) lens.field_kind = FieldKind::ObjectHeight, lens.field *= mm_;
    if (field_type_ == 2 || field_type_ == 3) lens.field_kind = FieldKind::ImageHeight, lens.field *= mm_;
    if (field_type_ == 3 && lens.field > 0)
        file_.warnings.emplace_back(
            "the field is a real image height; the paraxial height of that size is used");
    if (vignetting_factors_)
        file_.warnings.emplace_back("vignetting factors are not used; the clear apertures vignette");
}

Status Reader::set_aperture() {
    optics::Prescription& lens = file_.lens;
    lens.aperture_kind = aperture_.value_or(ApertureKind::StopRadius);
    if (lens.aperture_kind == ApertureKind::EntrancePupilDiameter) lens.aperture *= mm_;
    if (aperture_) return Done{};
    lens.aperture = lens.surfaces[std::size_t(lens.stop)].clear_radius_mm;
    if (std::isfinite(lens.aperture)) return Done{};
    return at_line(surfaces_[std::size_t(lens.stop) + 1].line,
                   "the stop has no diameter (DIAM), and no aperture is given otherwise");
}

Status Reader::finish() {
    if (const Status status = surfaces(); !status) return status.error();
    if (const Status status = set_aperture(); !status) return status.error();
    set_wavelengths();
    set_field();
    if (assumed_type_)
        file_.warnings.emplace_back("surfaces without TYPE are read as STANDARD, or as EVENASPH with PARM");
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
        } else if (!surfaces_.empty() && (line.indented || surface_words().contains(keyword))) {
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
