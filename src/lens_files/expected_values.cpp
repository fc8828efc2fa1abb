#include "lens_files/expected_values.h"

#include "lens_files/readers.h"
#include "optics/aberrations.h"
#include "optics/seidel.h"
#include "optics/traced_lens.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

namespace petzval::lens_files {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFloor = 1e-12;
// Share of a value that counts as its digits' doubt where no recomputation states a difference: the source's
// own indices and rounded radii are not known to more.
constexpr double kUnstated = 2e-6;

// Lens data that any quantity may use.
struct Subject {
    const optics::Prescription& lens;
    optics::FirstOrder first;
    optics::SeidelTable seidel;
    double image_mm = 0;  // last vertex to the published image plane
};

using Sum = double optics::SeidelSums::*;
const std::map<std::string, Sum> kSums = {
    {"S_I", &optics::SeidelSums::s1},  {"S_II", &optics::SeidelSums::s2}, {"S_III", &optics::SeidelSums::s3},
    {"S_IV", &optics::SeidelSums::s4}, {"S_V", &optics::SeidelSums::s5},  {"C_I", &optics::SeidelSums::c1},
    {"C_II", &optics::SeidelSums::c2}};

double image_height(const Subject& s) {
    const double slope = std::tan(s.seidel.field_deg * kDegree);
    if (std::isinf(s.lens.object_distance_mm)) return s.first.focal_length_mm * slope;
    return std::abs(s.first.magnification * slope *
                    (s.lens.object_distance_mm + s.first.entrance_pupil_position_mm));
}

const std::map<std::string, std::function<double(const Subject&)>> kNumbers = {
    {"EFL", [](const Subject& s) { return s.first.focal_length_mm; }},
    {"BFL", [](const Subject& s) { return s.first.back_focal_length_mm; }},
    {"FFL", [](const Subject& s) { return s.first.front_focal_position_mm; }},
    {"FFL_from_first_vertex", [](const Subject& s) { return s.first.front_focal_position_mm; }},
    {"EPL", [](const Subject& s) { return s.first.entrance_pupil_position_mm; }},
    {"EPL_from_first_vertex", [](const Subject& s) { return s.first.entrance_pupil_position_mm; }},
    {"EPD", [](const Subject& s) { return s.first.entrance_pupil_diameter_mm; }},
    {"XPL_from_last", [](const Subject& s) { return s.first.exit_pupil_position_mm; }},
    {"XPL_from_last_vertex", [](const Subject& s) { return s.first.exit_pupil_position_mm; }},
    {"XPL_from_image", [](const Subject& s) { return s.first.exit_pupil_position_mm - s.image_mm; }},
    {"XPD", [](const Subject& s) { return s.first.exit_pupil_diameter_mm; }},
    {"f_number", [](const Subject& s) { return s.first.f_number; }},
    {"NA",
     [](const Subject& s) { return s.first.entrance_pupil_diameter_mm / (2 * s.first.focal_length_mm); }},
    {"magnification", [](const Subject& s) { return s.first.magnification; }},
    {"image_distance", [](const Subject& s) { return s.first.image_distance_mm; }},
    {"vertex_length", [](const Subject& s) { return s.first.vertex_length_mm; }},
    {"petzval_radius", [](const Subject& s) { return s.first.petzval_radius_mm; }},
    {"petzval_radius_over_EFL",
     [](const Subject& s) { return s.first.petzval_radius_mm / s.first.focal_length_mm; }},
    {"lagrange_invariant", [](const Subject& s) { return s.seidel.lagrange_invariant_mm; }},
    {"paraxial_image_height", image_height},
    {"paraxial_image_height_at_field", image_height},
    {"field_deg", [](const Subject& s) { return s.seidel.field_deg; }},
    {"back_focus_over_focal_length_at_least",
     [](const Subject& s) { return s.first.back_focal_length_mm / s.first.focal_length_mm; }},
};

// Lists of numbers, surface by surface.
const std::map<std::string, std::function<std::vector<double>(const Subject&)>> kLists = {
    {"marginal_ray_heights", [](const Subject& s) { return s.seidel.marginal.height_mm; }},
    {"chief_ray_heights", [](const Subject& s) { return s.seidel.chief.height_mm; }},
    {"marginal_ray_angles_before_and_after_each_surface",
     [](const Subject& s) {
         auto slopes = s.seidel.marginal.slope_before;
         slopes.push_back(s.seidel.marginal.slope_after.back());
         return slopes;
     }},
    {"chief_ray_angles",
     [](const Subject& s) {
         auto slopes = s.seidel.chief.slope_before;
         slopes.push_back(s.seidel.chief.slope_after.back());
         return slopes;
     }},
};

// Half a unit of the last digit as written: "9.80313" gives 5e-6, "-8.8e-05" gives 5e-7.
double half_last_digit(const std::string& written) {
    const std::size_t e = written.find_first_of("eE"), dot = written.find('.');
    const std::size_t end = std::min(e, written.size());
    const int decimals = dot < end ? int(end - dot) - 1 : 0;
    const int exponent = e < written.size() ? std::atoi(written.c_str() + e + 1) : 0;
    return 0.5 * std::pow(10, exponent - decimals);
}

class Checker {
public:
    Checker(const Subject& subject, std::vector<ExpectedCheck>& out) : s_(subject), out_(out) {}

    Status check(const Json& entry);

private:
    ExpectedCheck& add(const std::string& part, double published, double ours, double allowed);
    double allowed(const Json& number) const;
    Status list(const Json& value, const std::vector<double>& ours, double allowed_each);
    Status members(const Json& value, const std::map<std::string, double>& ours);
    Status surfaces(const Json& value);
    Status one_sum(const Json& value, Sum sum);
    Status refraction_invariants(const Json& value, bool chief);
    Status rays(const Json& value);
    Status vignetting(const Json& value);
    Status focus_shift(const Json& value);
    Status wrong_form(const Json& value) const {
        return at_line(value.line,
                       "the value of " + quoted(quantity_) + " has a form that is not understood");
    }

    const Subject& s_;
    std::vector<ExpectedCheck>& out_;
    const Json* entry_ = nullptr;
    std::string quantity_, source_;
};

ExpectedCheck& Checker::add(const std::string& part, double published, double ours,
                            double allowed_difference) {
    ExpectedCheck check;
    check.quantity = part.empty() ? quantity_ : part;
    check.source = source_;
    check.published = published;
    check.ours = ours;
    check.allowed = std::max(allowed_difference, kFloor * std::abs(published));
    out_.push_back(check);
    return out_.back();
}

double Checker::allowed(const Json& number) const {
    if (const Json* tolerance = entry_->find("tolerance")) return std::abs(tolerance->number);
    const Json* difference = entry_->find("difference");
    if (!difference) return half_last_digit(number.string) + kUnstated * std::abs(number.number);
    // The difference itself is rounded to three digits.
    return 1.005 * std::abs(difference->number) + half_last_digit(number.string);
}

// allowed_each 0: as for single numbers.
Status Checker::list(const Json& value, const std::vector<double>& ours, double allowed_each) {
    if (!value.is(Json::Type::Array) || value.items.size() != ours.size()) return wrong_form(value);
    for (std::size_t i = 0; i < ours.size(); ++i)
        add(quantity_ + ", " + std::to_string(i + 1), value.items[i].number, ours[i],
            allowed_each > 0 ? allowed_each : allowed(value.items[i]));
    return Done{};
}

Status Checker::members(const Json& value, const std::map<std::string, double>& ours) {
    if (!value.is(Json::Type::Object)) return wrong_form(value);
    for (const auto& [name, number] : value.members) {
        const auto found = ours.find(name);
        if (found == ours.end()) return wrong_form(number);
        add(name, number.number, found->second, allowed(number));
    }
    return Done{};
}

// [[S_I…S_V of surface 1], …]
Status Checker::surfaces(const Json& value) {
    const char* names[] = {"S_I", "S_II", "S_III", "S_IV", "S_V", "C_I", "C_II"};
    if (value.items.size() != s_.seidel.surfaces.size()) return wrong_form(value);
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        const Json& row = value.items[i];
        if (row.items.size() > 7) return wrong_form(row);
        for (std::size_t k = 0; k < row.items.size(); ++k)
            add(std::string(names[k]) + ", surface " + std::to_string(i + 1), row.items[k].number,
                s_.seidel.surfaces[i].*kSums.at(names[k]), 5e-6);
    }
    return Done{};
}

Status Checker::one_sum(const Json& value, Sum sum) {
    std::vector<double> ours;
    for (const auto& surface : s_.seidel.surfaces) ours.push_back(surface.*sum);
    return list(value, ours, 5e-6);
}

// A = n (y c + u) at each surface.
Status Checker::refraction_invariants(const Json& value, bool chief) {
    const auto at = optics::at_wavelength(s_.lens, s_.lens.primary_um);
    const optics::ParaxialTrace& ray = chief ? s_.seidel.chief : s_.seidel.marginal;
    std::vector<double> ours;
    for (std::size_t i = 0; i < at.surfaces.size(); ++i)
        ours.push_back(at.surfaces[i].index_before *
                       (ray.height_mm[i] * at.surfaces[i].vertex_curvature_per_mm() + ray.slope_before[i]));
    return list(value, ours, 0);
}

// A row of published ray data as named numbers, and where our ray of those numbers lands.
struct RayRow {
    std::map<std::string, double> in;
    std::map<std::string, double> landing;
};

void trace_row(const Subject& s, const optics::LensAtWavelength& at, double image_mm, RayRow& row) {
    optics::Ray ray;
    double turn = 0;  // azimuth of the field against +y
    if (row.in.contains("start_y_at_stop_plane")) {
        const double m = row.in["direction_M_in"];
        ray = {{0, row.in["start_y_at_stop_plane"], 0}, {0, m, std::sqrt(1 - m * m)}};
    } else {
        const double hx = row.in["Hx"], hy = row.in.contains("H") ? row.in["H"] : row.in["Hy"];
        turn = std::atan2(hx, hy);
        const double c = std::cos(turn), n = std::sin(turn), px = row.in["Px"], py = row.in["Py"];
        ray = optics::paraxial_pupil_ray(s.lens, s.first, std::hypot(hx, hy) * s.seidel.field_deg,
                                         c * px - n * py, n * px + c * py);
    }
    const optics::TracedRay end = optics::trace(at, ray);
    if (end.fate != optics::RayFate::Passed) return;
    const optics::Vec3 p = optics::at_plane(end.ray, image_mm), d = end.ray.direction;
    const double c = std::cos(turn), n = std::sin(turn);
    row.landing = {{"x", c * p.x + n * p.y},
                   {"y", c * p.y - n * p.x},
                   {"L", c * d.x + n * d.y},
                   {"M", c * d.y - n * d.x}};
}

Status Checker::rays(const Json& value) {
    const Json *columns = value.find("columns"), *rows = value.find("rows");
    const Json *plane = value.find("image_plane_from_last_vertex"), *wavelength = value.find("wavelength_um");
    if (!columns || !rows || !plane) return wrong_form(value);
    const auto at = optics::at_wavelength(s_.lens, wavelength ? wavelength->number : s_.lens.primary_um);
    std::vector<double> finest(columns->items.size(), 1.0);  // of each column
    for (const Json& row : rows->items)
        for (std::size_t k = 0; k < row.items.size() && k < finest.size(); ++k)
            finest[k] = std::min(finest[k], half_last_digit(row.items[k].string));
    for (std::size_t i = 0; i < rows->items.size(); ++i) {
        const Json& row = rows->items[i];
        if (row.items.size() != columns->items.size()) return wrong_form(row);
        RayRow ray;
        for (std::size_t k = 0; k < row.items.size(); ++k)
            ray.in[columns->items[k].string] = row.items[k].number;
        trace_row(s_, at, plane->number, ray);
        for (std::size_t k = 0; k < row.items.size(); ++k) {
            const std::string& name = columns->items[k].string;
            if (name != "x" && name != "y" && name != "L" && name != "M") continue;
            const double ours =
                ray.landing.empty() ? std::numeric_limits<double>::quiet_NaN() : ray.landing[name];
            add("ray " + std::to_string(i + 1) + ", " + name, row.items[k].number, ours, finest[k]);
        }
    }
    return Done{};
}

// The share of the pupil's radius that rims cut from above (sign +1) or below (-1) at a field, rays unaimed.
// The stop's own rim counts, as vignetting factors describe the whole beam.
double vignetted_share(const Subject& s, double field_deg, double sign) {
    auto at = optics::at_wavelength(s.lens, s.lens.primary_um);
    at.stop = -1;
    const auto passes = [&](double py) {
        const auto end =
            optics::trace(at, optics::paraxial_pupil_ray(s.lens, s.first, field_deg, 0, sign * py));
        return end.fate == optics::RayFate::Passed && end.clearance <= 1;
    };
    double inside = 0, outside = 1;
    if (passes(1)) return 0;
    for (int i = 0; i < 50; ++i) (passes((inside + outside) / 2) ? inside : outside) = (inside + outside) / 2;
    return 1 - inside;
}

// Clear apertures were derived from these factors with the smallest circles that pass the beam; 0.05 is what
// one circle serving several fields may leave.
Status Checker::vignetting(const Json& value) {
    const Json *fields = value.find("fields_deg"), *upper = value.find("VUY"), *lower = value.find("VLY");
    if (!fields || !upper || !lower || upper->items.size() != fields->items.size() ||
        lower->items.size() != fields->items.size())
        return wrong_form(value);
    for (std::size_t i = 0; i < fields->items.size(); ++i) {
        const double field = fields->items[i].number;
        const std::string where = " at " + fields->items[i].string + " deg";
        add("VUY" + where, upper->items[i].number, vignetted_share(s_, field, 1), 0.05);
        add("VLY" + where, lower->items[i].number, vignetted_share(s_, field, -1), 0.05);
    }
    return Done{};
}

// The program that published it does not say by which measure; ours is the smallest mean square radius on the
// axis.
Status Checker::focus_shift(const Json& value) {
    const auto traced = optics::TracedLens::make(s_.lens, {});
    if (!traced) return traced.error();
    const auto beam = traced->beam(s_.lens.primary_um, 0);
    if (!beam) return beam.error();
    const std::vector<optics::Beam> beams{*beam};
    const double shift = optics::best_focus_shift_mm(beams, std::vector<double>{1.0});
    add("best focus from the paraxial one, axis only", value.number, shift, 0).comparable = false;
    return Done{};
}

Status Checker::check(const Json& entry) {
    const Json *quantity = entry.find("quantity"), *value = entry.find("value"),
               *source = entry.find("source");
    if (!quantity || !value) return at_line(entry.line, "an expected value needs a quantity and a value");
    entry_ = &entry;
    quantity_ = quantity->string;
    source_ = source ? source->string : "";
    const std::string& q = quantity_;
    if (const auto number = kNumbers.find(q); number != kNumbers.end()) {
        if (!value->is(Json::Type::Number)) return wrong_form(*value);
        auto& check = add("", value->number, number->second(s_), allowed(*value));
        check.one_sided = q == "back_focus_over_focal_length_at_least";
        return Done{};
    }
    if (const auto sum = kSums.find(q); sum != kSums.end()) {
        if (!value->is(Json::Type::Number)) return wrong_form(*value);
        add("", value->number, s_.seidel.sum.*sum->second, allowed(*value));
        return Done{};
    }
    const std::string per_surface = "seidel_per_surface_";
    if (q.starts_with(per_surface) && kSums.contains(q.substr(per_surface.size())))
        return one_sum(*value, kSums.at(q.substr(per_surface.size())));
    if (const auto found = kLists.find(q); found != kLists.end()) return list(*value, found->second(s_), 0);
    if (q == "marginal_ray_refraction_invariant_A") return refraction_invariants(*value, false);
    if (q == "chief_ray_refraction_invariant_Abar") return refraction_invariants(*value, true);
    if (q == "seidel_per_surface") return surfaces(*value);
    if (q == "real_rays_at_image") return rays(*value);
    if (q == "vignetting_factors") return vignetting(*value);
    if (q == "published_focus_shift") return focus_shift(*value);
    if (q == "wavefront_coefficients_in_waves_at_d") {
        const auto w = optics::wavefront_coefficients(s_.seidel.sum, s_.lens.primary_um);
        return members(*value, {{"W040", w.w040},
                                {"W131", w.w131},
                                {"W222", w.w222},
                                {"W220", w.w220_sagittal},
                                {"W311", w.w311}});
    }
    if (q == "transverse_third_order") {
        const auto t = optics::transverse_third_order(s_.seidel);
        return members(*value, {{"TSA", t.spherical},
                                {"TCO", t.tangential_coma},
                                {"TAS", t.tangential_astigmatism},
                                {"SAS", t.sagittal_astigmatism},
                                {"PTB", t.petzval},
                                {"DST", t.distortion}});
    }
    if (q == "field_curvatures") {
        const auto c = optics::third_order_field_curvatures(s_.seidel);
        return members(*value, {{"TCV", c.tangential}, {"SCV", c.sagittal}, {"PCV", c.petzval}});
    }
    return at_line(quantity->line, "expected quantity " + quoted(q) + " is not known");
}

}  // namespace

bool ExpectedCheck::passed() const {
    if (!comparable) return true;
    return one_sided ? ours >= published : std::abs(difference()) <= allowed;
}

std::string f_number_problem(const optics::Prescription& lens) {
    const auto traced = optics::TracedLens::make(lens, {});
    const auto share = traced ? optics::axial_open_share(*traced) : Result<double>(traced.error());
    if (!share || *share >= 1) return {};
    std::ostringstream text;
    text.precision(3);
    text << "its clear apertures pass no more than f/" << traced->f_number() / *share
         << " where the file states f/" << traced->f_number();
    return text.str();
}

Result<std::vector<ExpectedCheck>> check_expected(const Json& lens_entry, const optics::Prescription& lens) {
    const auto first = optics::first_order(lens, lens.primary_um);
    if (!first) return first.error();
    const Subject subject{lens, *first, optics::seidel(lens, *first, optics::seidel_field_deg(lens, *first)),
                          lens.surfaces.back().thickness_mm};
    std::vector<ExpectedCheck> checks;
    Checker checker(subject, checks);
    if (const Json* expected = lens_entry.find("expected"))
        for (const Json& entry : expected->items)
            if (const Status status = checker.check(entry); !status) return status.error();
    return checks;
}

}  // namespace petzval::lens_files
