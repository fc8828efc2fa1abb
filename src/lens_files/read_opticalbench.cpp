// The tab-separated text of photonstophotos.net's Optical Bench: sections in brackets; diameters, full
// angles; a zoom has several columns, of which the first is taken.
#include "lens_files/readers.h"

#include <cmath>
#include <map>

namespace petzval::lens_files {
namespace {

using optics::ApertureKind;
using optics::FieldKind;
using Cells = std::vector<std::string_view>;

class Reader {
public:
    Result<LensFile> read(const std::string& text);

private:
    Status row(const Line& line);
    Status surface(const Cells& cells, const Line& line);
    Status shape(const Cells& cells, const Line& line, optics::Surface& to);
    Status medium(const Cells& cells, const Line& line, optics::Surface& to);
    Status aspheric(const Cells& cells, const Line& line);
    Status finish();
    // A number, or a name of [variable distances].
    Result<double> length(std::string_view text, const Line& line) const;
    std::optional<double> variable(const std::string& name) const;

    LensFile file_;
    GlassFinder glasses_;
    std::string section_;
    std::map<std::string, Cells> variables_;  // values, of all columns
    std::map<std::string, std::size_t> surface_of_id_;
    int odd_terms_ = 0, first_even_power_ = 4;
    bool has_stop_ = false, several_columns_ = false;
};

std::string_view cell(const Cells& cells, std::size_t i) {
    return i < cells.size() ? cells[i] : std::string_view{};
}

std::optional<double> Reader::variable(const std::string& name) const {
    const auto found = variables_.find(name);
    if (found == variables_.end() || found->second.empty()) return std::nullopt;
    return parse_number(found->second.front());
}

Result<double> Reader::length(std::string_view text, const Line& line) const {
    if (const auto number = parse_number(text)) return *number;
    if (const auto value = variable(std::string(text))) return *value;
    return at_line(line.number, quoted(text) + " is neither a number nor one of the [variable distances]");
}

// The radius column: a number, Infinity, or AS (aperture stop), FS (field stop), CG (cover glass), all plane.
Status Reader::shape(const Cells& cells, const Line& line, optics::Surface& to) {
    const std::string kind = upper_case(cell(cells, 1));
    if (kind == "AS") {
        if (has_stop_) return at_line(line.number, "a second aperture stop (AS)");
        has_stop_ = true;
        file_.lens.stop = int(file_.lens.surfaces.size());
        return Done{};
    }
    if (kind == "FS" || kind == "CG") return Done{};
    const auto radius = parse_number(kind);
    if (!radius)
        return at_line(line.number,
                       quoted(cell(cells, 1)) + " is not a radius; a number, Infinity, AS, FS or CG is");
    if (std::isfinite(*radius) && *radius != 0) to.curvature_per_mm = 1 / *radius;
    return Done{};
}

Status Reader::medium(const Cells& cells, const Line& line, optics::Surface& to) {
    const std::string_view nd = cell(cells, 3), vd = cell(cells, 5);
    if (nd.empty() && cell(cells, 6).empty()) return Done{};
    GlassRequest request;
    request.line = line.number;
    request.name = std::string(cell(cells, 6));
    request.maker = std::string(cell(cells, 7));
    for (const auto& [text, to_number] : {std::pair{nd, &request.nd}, {vd, &request.vd}}) {
        if (text.empty()) continue;
        *to_number = parse_number(text);
        if (!*to_number) return at_line(line.number, quoted(text) + " is not an index or Abbe number");
    }
    if (request.nd && *request.nd == 1 && request.name.empty()) return Done{};
    const auto glass = glasses_.find(request);
    if (!glass) return glass.error();
    to.after = *glass;
    return Done{};
}

Status Reader::surface(const Cells& cells, const Line& line) {
    if (cells.size() < 3)
        return at_line(line.number, "a surface needs an id, a radius and a thickness, separated by tabs");
    if (file_.lens.surfaces.size() >= std::size_t(optics::kMostSurfaces))
        return at_line(line.number, "more than " + std::to_string(optics::kMostSurfaces) + " surfaces");
    optics::Surface to;
    if (const Status status = shape(cells, line, to); !status) return status.error();
    if (const Status status = medium(cells, line, to); !status) return status.error();
    if (!cell(cells, 2).empty()) {
        const auto thickness = length(cells[2], line);
        if (!thickness) return thickness.error();
        if (!std::isfinite(*thickness))
            return at_line(line.number, "the thickness of a surface must be finite");
        to.thickness_mm = *thickness;
    }
    if (!cell(cells, 4).empty()) {
        const auto diameter = length(cells[4], line);
        if (!diameter) return diameter.error();
        if (!(*diameter > 0)) return at_line(line.number, "a diameter must be positive");
        to.clear_radius_mm = *diameter / 2;
    }
    for (std::size_t i = 8; i < cells.size(); ++i)
        if (!cells[i].empty())
            return at_line(line.number, quoted(cells[i]) + " after the glass is not understood");
    surface_of_id_[std::string(cells[0])] = file_.lens.surfaces.size();
    file_.lens.surfaces.push_back(std::move(to));
    return Done{};
}

// id, radius, conic, then coefficients: of r^4, r^6…; with AsphericalA2 from r^2; with AsphericalOddCount n
// the first n odd powers from r^3 stand between them.
Status Reader::aspheric(const Cells& cells, const Line& line) {
    const auto found = surface_of_id_.find(std::string(cells[0]));
    if (found == surface_of_id_.end())
        return at_line(line.number,
                       "asphere for surface " + quoted(cells[0]) + ", which [lens data] does not have");
    optics::Surface& to = file_.lens.surfaces[found->second];
    std::vector<double> numbers;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        if (cells[i].empty()) continue;
        const auto value = parse_number(cells[i]);
        if (!value) return at_line(line.number, quoted(cells[i]) + " is not a number");
        numbers.push_back(*value);
    }
    if (numbers.size() < 2) return at_line(line.number, "an asphere needs a radius and a conic");
    const double radius = numbers[0];
    const double curvature = radius == 0 || std::isinf(radius) ? 0 : 1 / radius;
    if (std::abs(curvature - to.curvature_per_mm) > 1e-3 * std::abs(curvature) + 1e-9)
        return at_line(line.number, "surface " + quoted(cells[0]) + " has the radius " +
                                        std::string(cells[1]) +
                                        " here and another in [lens data]; a row is " +
                                        "surface, radius, conic, coefficients");
    to.conic = numbers[1];
    to.asphere.clear();
    int even = first_even_power_, odd = 3;
    for (std::size_t i = 2; i < numbers.size(); ++i) {
        const bool is_odd = odd < even && (odd - 3) / 2 < odd_terms_;
        const int power = is_odd ? odd : even;
        (is_odd ? odd : even) += 2;
        if (power > optics::kHighestAspherePower) return at_line(line.number, "too many coefficients");
        to.asphere.push_back({power, numbers[i]});
    }
    return Done{};
}

Status Reader::row(const Line& line) {
    const std::string_view text = trimmed(line.text);
    if (text.empty() || text.front() == '#') return Done{};
    if (text.front() == '[') {
        section_ = upper_case(text);
        const bool known = section_ == "[DESCRIPTIVE DATA]" || section_ == "[CONSTANTS]" ||
                           section_ == "[LENS DATA]" || section_ == "[VARIABLE DISTANCES]" ||
                           section_ == "[ASPHERICAL DATA]" || section_ == "[FIGURE]" ||
                           section_ == "[NOTES]" || section_ == "[PATENT INFO]" ||
                           section_ == "[REPORT DATA]" || section_ == "[GROUP DATA]";
        if (!known) return at_line(line.number, "section " + quoted(text) + " is not understood");
        return Done{};
    }
    const Cells cells = split_tabs(line.text);
    if (section_ == "[LENS DATA]") return surface(cells, line);
    if (section_ == "[ASPHERICAL DATA]") return aspheric(cells, line);
    if (section_ == "[DESCRIPTIVE DATA]") {
        if (upper_case(cells[0]) == "TITLE") file_.lens.name = std::string(cell(cells, 1));
    } else if (section_ == "[CONSTANTS]") {
        const std::string name = upper_case(cells[0]);
        const double value = parse_number(cell(cells, 1)).value_or(0);
        if (name == "ASPHERICALODDCOUNT") odd_terms_ = value >= 0 && value < 20 ? int(value) : 0;
        if (name == "ASPHERICALA2") first_even_power_ = 2;
    } else if (section_ == "[VARIABLE DISTANCES]") {
        Cells values(cells.begin() + 1, cells.end());
        while (!values.empty() && values.back().empty()) values.pop_back();
        several_columns_ = several_columns_ || values.size() > 1;
        variables_[std::string(cells[0])] = std::move(values);
    }
    return Done{};
}

Status Reader::finish() {
    file_.printed_focal_length_mm = variable("Focal Length").value_or(0);
    file_.printed_f_number = variable("F-Number").value_or(0);
    optics::Prescription& lens = file_.lens;
    if (lens.surfaces.empty()) return at_line(1, "[lens data] holds no surface");
    if (!has_stop_) file_.warnings.emplace_back("no aperture stop (AS) is given; the first surface is taken");
    if (const auto f_number = variable("F-Number"); f_number && *f_number > 0) {
        lens.aperture_kind = ApertureKind::FNumber;
        lens.aperture = *f_number;
    } else {
        lens.aperture_kind = ApertureKind::StopRadius;
        lens.aperture = variable("Aperture Diameter")
                            .value_or(2 * lens.surfaces[std::size_t(lens.stop)].clear_radius_mm) /
                        2;
        if (!std::isfinite(lens.aperture))
            return at_line(1, "neither an F-Number nor a diameter of the aperture stop is given");
    }
    if (const auto object = variable("d0"); object && *object < 1e9) {
        if (!(*object > 0)) return at_line(1, "d0, the object's distance, must be positive or Infinity");
        lens.object_distance_mm = *object;
    }
    const auto angle = variable("Angle of View"), height = variable("Image Height");
    if (angle && *angle > 0 && std::isfinite(*angle)) {
        lens.field = *angle / 2;
    } else if (height && *height > 0 && std::isfinite(*height)) {
        lens.field_kind = FieldKind::ImageHeight;
        lens.field = *height / 2;
    }
    if (several_columns_)
        file_.warnings.emplace_back("the file has several positions (zoom or focus); the first is read");
    glasses_.report(file_.warnings);
    warn_of_models(file_);
    assume_field(file_);
    return Done{};
}

Result<LensFile> Reader::read(const std::string& text) {
    file_.format = "Optical Bench";
    for (const Line& line : split_lines(text))
        if (const Status status = row(line); !status) return status.error();
    if (const Status status = finish(); !status) return status.error();
    return std::move(file_);
}

}  // namespace

Result<LensFile> read_optical_bench(const std::string& text) { return Reader().read(text); }

}  // namespace petzval::lens_files
