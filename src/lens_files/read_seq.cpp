// CODE V sequence files: commands separated by ends of lines or ';', '!' starts a comment, '&' continues a
// line. S, SO and SI begin a surface; what follows belongs to it.
#include "lens_files/readers.h"
#include "optics/least_squares.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace petzval::lens_files {
namespace {

using optics::ApertureKind;
using optics::FieldKind;
using Words = std::vector<std::string>;

// Keywords of aspheric coefficients: of r^4, r^6, r^8….
constexpr std::string_view kAsphereOrders = "ABCDEFGHJ";

struct Command {
    int line = 0;
    Words words;  // as written; words[0] in upper case
};

// Harmless in a surface: labels, comments, control codes of the optimiser.
const std::set<std::string> kHarmlessInSurface = {"ASP", "SPH", "CON", "CCY", "THC", "GLC", "KC",
                                                  "AC",  "BC",  "CC",  "DC",  "EC",  "FC",  "GC",
                                                  "HC",  "JC",  "SLB", "PIM", "COM", "CUC"};
// Harmless for the lens as a whole: weights, title data, results, how pupils are sampled.
const std::set<std::string> kHarmless = {"LEN", "WTW", "WTF", "WTX", "WTY", "INI", "TEM", "PRE", "AFC",
                                         "DER", "GO",  "CWL", "SAV", "DDM", "UID", "EVR", "LIS", "VIE",
                                         "COM", "PUI", "PUX", "PUY", "PFR", "PTP", "POR"};  // the last three:
                                                                                            // polarisation

class Reader {
public:
    Result<LensFile> read(const std::string& text);

private:
    // Handler of a keyword; words[0] is the keyword.
    using Handler = Status (Reader::*)(const Command& c);
    static const std::map<std::string, Handler>& general_words();
    static const std::map<std::string, Handler>& surface_words();
    Status command(const Command& c);

    Status radius_mode(const Command& c);
    Status title(const Command& c);
    Status unit(const Command& c);
    Status wavelengths(const Command& c);
    Status reference(const Command& c);
    Status aperture(const Command& c);
    Status fields(const Command& c);
    Status vignetting(const Command& c);
    Status begin_private(const Command& c);
    Status private_glass(const Command& c);

    Status begin_surface(const Command& c);
    Status object(const Command& c, double curvature, double thickness);
    Status image(const Command& c, double thickness);
    Status stop(const Command& c);
    Status circular_aperture(const Command& c);
    Status aspheric(const Command& c);
    Status change_glass(const Command& c);
    Result<optics::Glass> glass(const std::string& word, int line);

    static Result<double> number(const Command& c, std::size_t i);
    static Result<std::vector<double>> numbers(const Command& c);
    Status set_aperture();
    void set_wavelengths();
    void set_field();
    Status finish();

    LensFile file_;
    optics::GlassCatalogue private_;
    GlassFinder glasses_;
    Ignored ignored_;
    double mm_ = 1;
    double steepest_ = 0;  // largest curvature that was stated as one, per unit of the file
    bool radius_mode_ = false, in_private_ = false, has_stop_ = false, seen_image_ = false;
    int stop_line_ = 0;
    bool vignetting_factors_ = false, zoom_ = false;
    bool edge_only_ = false;                // the current surface's radius is that of its edge
    std::optional<ApertureKind> aperture_;  // none: the stop's clear radius rules
    std::vector<double> private_wavelengths_um_;
    std::vector<double> x_fields_, y_fields_;
    int reference_ = 0;
    std::vector<double> wavelengths_nm_;
    optics::Surface* current_ = nullptr;  // nullptr: not in a surface of the lens
};

// A line without its comment; ';' outside quotes becomes an end of line.
std::string without_comment(std::string_view line) {
    std::string cleaned;
    char quote = 0;
    for (const char c : line) {
        if (quote == 0 && c == '!') break;
        const bool opens = quote == 0 && (c == '"' || c == '\'');
        if (opens || c == quote) quote = opens ? c : '\0';
        cleaned += quote == 0 && c == ';' ? '\n' : c;
    }
    return cleaned;
}

void add_commands(const std::string& text, int line, std::vector<Command>& commands) {
    for (const Line& part : split_lines(text)) {
        Command command{line, {}};
        for (const auto word : split_words(part.text)) command.words.emplace_back(word);
        if (command.words.empty()) continue;
        command.words[0] = upper_case(command.words[0]);
        commands.push_back(std::move(command));
    }
}

// The text as commands; a line that ends in '&' continues in the next one.
std::vector<Command> commands_of(const std::string& text) {
    std::vector<Command> commands;
    std::string pending;
    int first_line = 0;
    for (const Line& line : split_lines(text)) {
        if (pending.empty()) first_line = line.number;
        const std::string cleaned = without_comment(line.text);
        const std::string_view rest = trimmed(cleaned);
        if (!rest.empty() && rest.back() == '&' && pending.size() < 10000) {
            pending.append(rest.substr(0, rest.size() - 1)).append(" ");
            continue;
        }
        add_commands(pending.append(cleaned), first_line, commands);
        pending.clear();
    }
    return commands;
}

Result<double> Reader::number(const Command& c, std::size_t i) {
    if (i >= c.words.size()) return at_line(c.line, c.words[0] + " needs " + std::to_string(i) + " values");
    const auto value = parse_number(c.words[i]);
    if (!value) return at_line(c.line, quoted(c.words[i]) + " of " + c.words[0] + " is not a number");
    return *value;
}

Result<std::vector<double>> Reader::numbers(const Command& c) {
    std::vector<double> values;
    for (std::size_t i = 1; i < c.words.size(); ++i) {
        const auto value = number(c, i);
        if (!value) return value.error();
        values.push_back(*value);
    }
    return values;
}

// A fictitious glass "nnnvvv", "nnn.vvv" or "nnnnnn.vvvvvv": digits of nd - 1 and of Vd (two before the
// point).
std::optional<optics::Glass> glass_of_code(const std::string& word) {
    if (word.find_first_not_of("0123456789.") != std::string::npos) return std::nullopt;
    const std::size_t dot = word.find('.');
    if (dot == std::string::npos && word.size() != 6) return std::nullopt;
    const std::string n = word.substr(0, dot == std::string::npos ? 3 : dot);
    const std::string v = word.substr(dot == std::string::npos ? 3 : dot + 1);
    if (n.empty() || v.size() < 2 || n.size() > 9 || v.size() > 9 || v.find('.') != std::string::npos)
        return std::nullopt;
    const double nd = 1 + std::stod(n) / std::pow(10, double(n.size()));
    const double vd = std::stod(v) / std::pow(10, double(v.size()) - 2);
    if (nd <= 1 || vd <= 0) return std::nullopt;
    return optics::abbe_glass(word, nd, vd);
}

Result<optics::Glass> Reader::glass(const std::string& word, int line) {
    const std::string upper = upper_case(word);
    if (upper == "AIR") return optics::Glass{};
    if (upper == "REFL") return at_line(line, "mirrors (REFL) are not supported");
    if (const auto coded = glass_of_code(word)) return *coded;
    GlassRequest request;
    request.line = line;
    const std::size_t bar = word.rfind('_');
    request.name = word.substr(0, bar);
    if (bar != std::string::npos) request.maker = word.substr(bar + 1);
    return glasses_.find(request);
}

Status Reader::object(const Command& c, double curvature, double thickness) {
    if (curvature != 0)
        file_.warnings.push_back("line " + std::to_string(c.line) + ": the object is taken as flat");
    if (thickness < 1e9) file_.lens.object_distance_mm = thickness * mm_;
    current_ = nullptr;
    if (c.words.size() > 3 && upper_case(c.words[3]) != "AIR")
        return at_line(c.line, "an object inside glass is not supported");
    return Done{};
}

Status Reader::image(const Command& c, double thickness) {
    seen_image_ = true;
    current_ = nullptr;
    if (thickness != 0)
        file_.warnings.push_back("line " + std::to_string(c.line) + ": the image is defocused by " +
                                 c.words[2] + " in the file; focus is set by the program here");
    return Done{};
}

Status Reader::begin_surface(const Command& c) {
    auto curvature = number(c, 1);
    const auto thickness = c.words.size() > 2 ? number(c, 2) : Result<double>(0.0);
    if (!curvature) return curvature.error();
    if (!thickness) return thickness.error();
    if (radius_mode_ && *curvature != 0) curvature = 1 / *curvature;
    if (c.words[0] == "SO") return object(c, *curvature, *thickness);
    if (c.words[0] == "SI") return image(c, *thickness);
    if (!std::isfinite(*thickness)) return at_line(c.line, "the thickness of a surface must be finite");
    auto& surfaces = file_.lens.surfaces;
    if (surfaces.size() >= std::size_t(optics::kMostSurfaces))
        return at_line(c.line, "more than " + std::to_string(optics::kMostSurfaces) + " surfaces");
    if (surfaces.empty()) glasses_ = GlassFinder(private_);
    edge_only_ = false;
    optics::Surface surface;
    surface.curvature_per_mm = *curvature / mm_;
    if (!radius_mode_) steepest_ = std::max(steepest_, std::abs(*curvature));
    surface.thickness_mm = *thickness * mm_;
    if (c.words.size() > 3) {
        const auto behind = glass(c.words[3], c.line);
        if (!behind) return behind.error();
        surface.after = *behind;
    }
    if (c.words.size() > 4) return at_line(c.line, quoted(c.words[4]) + " after the glass is not understood");
    surfaces.push_back(std::move(surface));
    current_ = &surfaces.back();
    return Done{};
}

// CIR r, CIR EDG r (the glass's edge: taken where no clear aperture is given).
Status Reader::circular_aperture(const Command& c) {
    const std::string kind = c.words.size() > 2 ? upper_case(c.words[1]) : "";
    if (!kind.empty() && kind != "EDG" && kind != "CLR")
        return at_line(c.line,
                       "CIR " + c.words[1] + " (an obscuration, hole or other surface) is not supported");
    const auto radius = number(c, kind.empty() ? 1 : 2);
    if (!radius) return radius.error();
    const bool has_one = std::isfinite(current_->clear_radius_mm);
    if (kind == "EDG" && has_one && !edge_only_) return Done{};
    if (*radius > 0) current_->clear_radius_mm = *radius * mm_;
    edge_only_ = kind == "EDG";
    return Done{};
}

// K is the conic; A, B, C… belong to r^4, r^6, r^8….
Status Reader::aspheric(const Command& c) {
    const auto value = number(c, 1);
    if (!value) return value.error();
    if (c.words[0] == "K") {
        current_->conic = *value;
        return Done{};
    }
    const std::size_t order = kAsphereOrders.find(c.words[0][0]);
    const int power = 4 + 2 * int(order);
    current_->asphere.push_back({power, *value * std::pow(mm_, 1 - power)});
    return Done{};
}

Status Reader::stop(const Command& c) {
    if (has_stop_) return at_line(c.line, "a second STO");
    has_stop_ = true;
    file_.lens.stop = int(file_.lens.surfaces.size()) - 1;
    if (c.words.size() < 2) return Done{};
    // "STO S3", where the object is surface 0.
    const std::string surface = upper_case(c.words[1]);
    const auto number = parse_number(surface.substr(surface[0] == 'S' ? 1 : 0));
    if (!number || !(*number >= 1 && *number <= optics::kMostSurfaces) || *number != std::floor(*number))
        return at_line(c.line, quoted(c.words[1]) + " is not a surface number for STO");
    file_.lens.stop = int(*number) - 1;
    stop_line_ = c.line;
    return Done{};
}

Status Reader::change_glass(const Command& c) {
    if (c.words.size() != 2) return at_line(c.line, "GLA needs one glass");
    const auto behind = glass(c.words[1], c.line);
    if (!behind) return behind.error();
    current_->after = *behind;
    return Done{};
}

// PRV … END: PWL wavelengths in nm, then 'NAME' indices. n^2 as a polynomial in 1/w^2 through all of them.
Status Reader::private_glass(const Command& c) {
    if (c.words[0] == "END") {
        in_private_ = false;
        return Done{};
    }
    const auto values = numbers(c);
    if (!values) return values.error();
    if (c.words[0] == "PWL") {
        private_wavelengths_um_.clear();
        for (const double nm : *values) private_wavelengths_um_.push_back(nm / 1000);
        return Done{};
    }
    const std::size_t count = values->size();
    if (count == 0 || count > 8 || count != private_wavelengths_um_.size())
        return at_line(c.line, "a private glass needs one index for each wavelength of PWL (1 to 8)");
    std::vector<std::vector<double>> rows;
    std::vector<double> squares;
    for (std::size_t i = 0; i < count; ++i) {
        auto& row = rows.emplace_back();
        for (std::size_t k = 0; k < count; ++k)
            row.push_back(std::pow(private_wavelengths_um_[i], -2.0 * double(k)));
        squares.push_back((*values)[i] * (*values)[i]);
    }
    const auto solution = optics::least_squares(std::move(rows), std::move(squares));
    if (solution.empty()) return at_line(c.line, "the wavelengths of PWL must differ");
    optics::Glass glass;
    glass.name = c.words[0];
    glass.formula = optics::Dispersion::PowerSeries;
    for (std::size_t k = 0; k < count; ++k) glass.terms.push_back({solution[k], -2.0 * double(k)});
    private_.add(std::move(glass));
    return Done{};
}

Status Reader::begin_private(const Command&) {
    in_private_ = true;
    return Done{};
}

Status Reader::radius_mode(const Command& c) {
    radius_mode_ = c.words.size() < 2 || upper_case(c.words[1]) != "N";
    return Done{};
}

Status Reader::title(const Command& c) {
    if (c.words.size() > 1) file_.lens.name = c.words[1];
    return Done{};
}

Status Reader::unit(const Command& c) {
    const std::string unit = c.words.size() > 1 ? upper_case(c.words[1]).substr(0, 1) : "";
    if (unit != "M" && unit != "C" && unit != "I") return at_line(c.line, "DIM must be M, C or I");
    if (!file_.lens.surfaces.empty()) return at_line(c.line, "DIM must stand before the surfaces");
    mm_ = unit == "C" ? 10 : unit == "I" ? 25.4 : 1;
    return Done{};
}

Status Reader::wavelengths(const Command& c) {
    const auto values = numbers(c);
    if (!values) return values.error();
    wavelengths_nm_ = *values;
    return Done{};
}

Status Reader::reference(const Command& c) {
    const auto value = number(c, 1);
    if (!value) return value.error();
    reference_ = int(std::clamp(*value, 0.0, 1000.0));
    return Done{};
}

Status Reader::aperture(const Command& c) {
    const std::map<std::string, ApertureKind> kinds = {{"EPD", ApertureKind::EntrancePupilDiameter},
                                                       {"FNO", ApertureKind::FNumber},
                                                       {"NA", ApertureKind::FNumber},
                                                       {"NAO", ApertureKind::ObjectNA}};
    const auto value = number(c, 1);
    if (!value) return value.error();
    aperture_ = kinds.at(c.words[0]);
    file_.lens.aperture = c.words[0] == "NA" ? 1 / (2 * *value) : *value;
    return Done{};
}

Status Reader::fields(const Command& c) {
    const std::map<std::string, FieldKind> kinds = {{"AN", FieldKind::AngleDeg},
                                                    {"OB", FieldKind::ObjectHeight},
                                                    {"IM", FieldKind::ImageHeight},
                                                    {"RI", FieldKind::ImageHeight}};
    const auto values = numbers(c);
    if (!values) return values.error();
    (c.words[0][0] == 'X' ? x_fields_ : y_fields_) = *values;
    file_.lens.field_kind = kinds.at(c.words[0].substr(1));
    return Done{};
}

Status Reader::vignetting(const Command& c) {
    const auto values = numbers(c);
    if (!values) return values.error();
    for (const double value : *values) vignetting_factors_ = vignetting_factors_ || value != 0;
    return Done{};
}

const std::map<std::string, Reader::Handler>& Reader::general_words() {
    static const std::map<std::string, Handler> words = {
        {"S", &Reader::begin_surface}, {"SO", &Reader::begin_surface}, {"SI", &Reader::begin_surface},
        {"RDM", &Reader::radius_mode}, {"TIT", &Reader::title},        {"TITLE", &Reader::title},
        {"DIM", &Reader::unit},        {"WL", &Reader::wavelengths},   {"REF", &Reader::reference},
        {"EPD", &Reader::aperture},    {"FNO", &Reader::aperture},     {"NA", &Reader::aperture},
        {"NAO", &Reader::aperture},    {"XAN", &Reader::fields},       {"YAN", &Reader::fields},
        {"XOB", &Reader::fields},      {"YOB", &Reader::fields},       {"XIM", &Reader::fields},
        {"YIM", &Reader::fields},      {"XRI", &Reader::fields},       {"YRI", &Reader::fields},
        {"VUX", &Reader::vignetting},  {"VUY", &Reader::vignetting},   {"VLX", &Reader::vignetting},
        {"VLY", &Reader::vignetting},  {"PRV", &Reader::begin_private}};
    return words;
}

const std::map<std::string, Reader::Handler>& Reader::surface_words() {
    static const std::map<std::string, Handler> words = [] {
        std::map<std::string, Handler> all = {{"STO", &Reader::stop},
                                              {"CIR", &Reader::circular_aperture},
                                              {"GLA", &Reader::change_glass},
                                              {"K", &Reader::aspheric}};
        for (const char order : kAsphereOrders) all[std::string(1, order)] = &Reader::aspheric;
        return all;
    }();
    return words;
}

Status Reader::command(const Command& c) {
    const std::string& word = c.words[0];
    if (in_private_) return private_glass(c);
    if (const auto found = general_words().find(word); found != general_words().end())
        return (this->*found->second)(c);
    if (current_) {
        if (const auto found = surface_words().find(word); found != surface_words().end())
            return (this->*found->second)(c);
        if (kHarmlessInSurface.contains(word)) {
            if (word != "ASP" && word != "SPH" && word != "SLB" && word != "CON") ignored_.add(word);
            return Done{};
        }
    }
    if (word == "ZOO") {  // how many positions, then what changes between them
        if (!zoom_)
            file_.warnings.push_back("line " + std::to_string(c.line) + ": a zoom, in its first position");
        zoom_ = true;
        return Done{};
    }
    // Solves, weights and commands follow the image.
    if (!kHarmless.contains(word) && !seen_image_)
        return at_line(c.line, quoted(word) + " is not understood or not supported");
    ignored_.add(word.substr(0, 20));
    return Done{};
}

Status Reader::set_aperture() {
    optics::Prescription& lens = file_.lens;
    lens.aperture_kind = aperture_.value_or(ApertureKind::StopRadius);
    if (aperture_ == ApertureKind::EntrancePupilDiameter) lens.aperture *= mm_;
    if (aperture_) return Done{};
    lens.aperture = lens.surfaces[std::size_t(lens.stop)].clear_radius_mm;
    if (std::isfinite(lens.aperture)) return Done{};
    return at_line(1, "no aperture is given: EPD, FNO, NA, NAO or CIR at the stop");
}

void Reader::set_wavelengths() {
    optics::Prescription& lens = file_.lens;
    if (wavelengths_nm_.empty()) return;
    const std::size_t count = wavelengths_nm_.size();
    const std::size_t reference = reference_ > 0 ? std::min(std::size_t(reference_), count) : (count + 1) / 2;
    lens.primary_um = wavelengths_nm_[reference - 1] / 1000;
    const auto [shortest, longest] = std::minmax_element(wavelengths_nm_.begin(), wavelengths_nm_.end());
    if (*shortest < *longest) {
        lens.short_um = *shortest / 1000;
        lens.long_um = *longest / 1000;
    } else {
        file_.warnings.emplace_back("the file has one wavelength; colour is taken between the F and C lines");
    }
}

void Reader::set_field() {
    optics::Prescription& lens = file_.lens;
    for (std::size_t i = 0; i < std::max(x_fields_.size(), y_fields_.size()); ++i) {
        const double x = i < x_fields_.size() ? x_fields_[i] : 0, y = i < y_fields_.size() ? y_fields_[i] : 0;
        lens.field = std::max(lens.field, std::hypot(x, y));
    }
    if (lens.field_kind != FieldKind::AngleDeg) lens.field *= mm_;
    if (vignetting_factors_)
        file_.warnings.emplace_back("vignetting factors are not used; the clear apertures vignette");
}

Status Reader::finish() {
    if (file_.lens.surfaces.empty()) return at_line(1, "no surface (S) is given");
    if (!has_stop_) file_.warnings.emplace_back("no surface is marked STO; the first is taken");
    if (steepest_ > 1)
        file_.warnings.emplace_back(
            "without RDM, the first number of a surface is its curvature; if it is the "
            "radius here, put RDM into the first line");
    if (file_.lens.stop >= int(file_.lens.surfaces.size()))
        return at_line(stop_line_, "STO names a surface that the lens does not have");
    if (const Status status = set_aperture(); !status) return status.error();
    set_wavelengths();
    set_field();
    glasses_.report(file_.warnings);
    warn_of_models(file_);
    assume_field(file_);
    ignored_.report(file_.warnings);
    return Done{};
}

Result<LensFile> Reader::read(const std::string& text) {
    file_.format = "CODE V .seq";
    for (const Command& c : commands_of(text))
        if (const Status status = command(c); !status) return status.error();
    if (const Status status = finish(); !status) return status.error();
    return std::move(file_);
}

}  // namespace

Result<LensFile> read_seq(const std::string& text) { return Reader().read(text); }

}  // namespace petzval::lens_files
