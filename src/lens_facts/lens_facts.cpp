#include "petzval/lens_facts.h"

#include "kernel/lenses/aberration_curves.h"
#include "kernel/lenses/opened_lens.h"
#include "lens_files/expected_values.h"
#include "lens_files/shelf.h"
#include "optics/aberrations.h"
#include "optics/buildable.h"
#include "optics/seidel.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

namespace petzval {
namespace {

constexpr int kZones = 10, kFieldPoints = 11;

LensSummary ideal_summary() {
    LensSummary summary;
    summary.name = "ideal";
    summary.title = "No aberration: a flat disc";
    summary.kind = "ideal";
    summary.model = LensModelKind::Ideal;
    return summary;
}

LensSummary summary_of(const kernel::AberrationCurves& curves) {
    LensSummary summary;
    summary.name = curves.name;
    summary.title = curves.description;
    summary.kind = "aberration curves";
    summary.source = "drawn for petzval, after M. Kawase, CEDEC 2008";
    summary.model = LensModelKind::Curves;
    summary.focal_length_mm = curves.focal_length_mm;
    summary.f_number = curves.f_number;
    return summary;
}

LensSummary summary_of(const optics::Prescription& lens, const optics::FirstOrder& first) {
    LensSummary summary;
    summary.name = lens.id;
    summary.title = lens.name;
    summary.kind = lens.kind;
    summary.year = lens.year;
    summary.source = lens.source;
    summary.history = lens.history;
    summary.names = lens.names;
    summary.focal_length_mm = first.focal_length_mm;
    summary.f_number = first.f_number;
    return summary;
}

SeidelFacts facts_of(const optics::SeidelSums& s) { return {s.s1, s.s2, s.s3, s.s4, s.s5, s.c1, s.c2}; }

std::vector<double> zones() {
    std::vector<double> result;
    for (int i = 1; i <= kZones; ++i) result.push_back(double(i) / kZones);
    return result;
}

// g and the lens's own wavelengths, rising, each once.
std::vector<double> wavelengths_of(const optics::Prescription& lens) {
    std::vector<double> result;
    for (const double um : {optics::kLineG_um, lens.short_um, lens.primary_um, lens.long_um})
        if (result.empty() || um > result.back()) result.push_back(um);
    return result;
}

void add_first_order(LensFacts& facts, const optics::Prescription& lens, const optics::FirstOrder& first) {
    facts.efl_mm = first.focal_length_mm;
    facts.bfl_mm = first.back_focal_length_mm;
    facts.f_number = first.f_number;
    facts.front_focal_position_mm = first.front_focal_position_mm;
    facts.entrance_pupil_position_mm = first.entrance_pupil_position_mm;
    facts.entrance_pupil_diameter_mm = first.entrance_pupil_diameter_mm;
    facts.exit_pupil_position_mm = first.exit_pupil_position_mm;
    facts.exit_pupil_diameter_mm = first.exit_pupil_diameter_mm;
    facts.vertex_length_mm = first.vertex_length_mm;
    facts.petzval_radius_mm = first.petzval_radius_mm;
    facts.object_distance_mm = lens.object_distance_mm;
    facts.image_distance_mm = first.image_distance_mm;
    facts.magnification = first.magnification;
    facts.field_deg = optics::field_angle_deg(lens, first);
    facts.sensor_width_mm = optics::format_width_mm(lens, first);
    facts.short_um = lens.short_um;
    facts.primary_um = lens.primary_um;
    facts.long_um = lens.long_um;
}

void add_seidel(LensFacts& facts, const optics::Prescription& lens, const optics::FirstOrder& first) {
    facts.seidel_field_deg = optics::seidel_field_deg(lens, first);
    const optics::SeidelTable table = optics::seidel(lens, first, facts.seidel_field_deg);
    facts.lagrange_invariant_mm = table.lagrange_invariant_mm;
    facts.seidel = facts_of(table.sum);
    for (const optics::SeidelSums& surface : table.surfaces)
        facts.seidel_per_surface.push_back(facts_of(surface));
    facts.seidel_complete = table.complete;
    if (!table.complete)
        facts.warnings.emplace_back("odd aspheric powers below 4 are left out of the third-order sums");
    if (facts.field_deg >= 89 && lens.paraxial_field_deg == 0)
        facts.warnings.emplace_back(
            "third-order sums are for 20 degrees, because they have no meaning for so wide a field");
}

Status add_field(LensFacts& facts, const optics::Prescription& lens, const optics::FirstOrder& first) {
    optics::LensSetting setting;
    setting.focus_distance_mm = lens.object_distance_mm + first.entrance_pupil_position_mm;
    const auto traced = optics::TracedLens::make(lens, setting);
    if (!traced) return traced.error();
    for (int i = 0; i < kFieldPoints; ++i) {
        const double field_deg = facts.field_deg * i / (kFieldPoints - 1);
        const auto point = optics::field_point(*traced, field_deg);
        if (!point) {
            facts.warnings.emplace_back("curves over the field end early: " + point.error().message);
            break;
        }
        facts.field.push_back({point->field_deg, point->image_height_mm, point->tangential_focus_mm,
                               point->sagittal_focus_mm, point->distortion_percent, point->lateral_colour_mm,
                               point->unvignetted_share});
        if (facts.field_deg == 0) break;
    }
    return Done{};
}

LensFacts facts_of(const kernel::AberrationCurves& curves) {
    LensFacts facts;
    facts.summary = summary_of(curves);
    facts.efl_mm = curves.focal_length_mm;
    facts.sensor_width_mm = curves.sensor_width_mm;
    facts.f_number = curves.f_number;
    auto& lsa = facts.longitudinal_aberration;
    const double rim = 1 / (2 * curves.f_number);  // focal lengths
    for (const double height : curves.pupil_height) lsa.zones.push_back(height / rim);
    for (std::size_t w = 0; w < curves.wavelength_nm.size(); ++w) {
        lsa.wavelengths_um.push_back(curves.wavelength_nm[w] / 1000);
        auto& shifts = lsa.shift_mm.emplace_back();
        for (const double shift : curves.shift[w]) shifts.push_back(shift * curves.focal_length_mm);
    }
    return facts;
}

std::string differs(const char* what, double printed, double ours, const char* unit) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "the table prints %s of %g%s; these surfaces have %.4g%s", what,
                  printed, unit, ours, unit);
    return text.data();
}

std::vector<std::string> doubts_about(const LensFacts& facts, const optics::Prescription& lens,
                                      const optics::FirstOrder& first) {
    constexpr double kDiffers = 0.01;  // more than patents round by
    const auto is_off = [](double ours, double printed) {
        return printed > 0 && std::abs(ours / printed - 1) > kDiffers;
    };
    std::vector<std::string> doubts;
    if (is_off(first.focal_length_mm, facts.printed_efl_mm))
        doubts.push_back(differs("a focal length", facts.printed_efl_mm, first.focal_length_mm, " mm"));
    if (is_off(first.f_number, facts.printed_f_number))
        doubts.push_back(differs("an f-number", facts.printed_f_number, first.f_number, ""));
    if (const std::string problem = lens_files::f_number_problem(lens); !problem.empty())
        doubts.push_back(problem);
    for (std::string& doubt : optics::build_doubts(lens)) doubts.push_back(std::move(doubt));
    return doubts;
}

Result<LensFacts> facts_of(const lens_files::LensFile& file) {
    const optics::Prescription& lens = file.lens;
    const auto first = optics::first_order(lens, lens.primary_um);
    if (!first) return first.error();
    LensFacts facts;
    facts.summary = summary_of(lens, *first);
    facts.format = file.format;
    facts.notes = lens.notes;
    facts.warnings = file.warnings;
    facts.has_prescription = true;
    facts.printed_efl_mm = file.printed_focal_length_mm;
    facts.printed_f_number = file.printed_f_number;
    facts.doubts = doubts_about(facts, lens, *first);
    facts.warnings.insert(facts.warnings.end(), facts.doubts.begin(), facts.doubts.end());
    add_first_order(facts, lens, *first);
    add_seidel(facts, lens, *first);
    const auto lsa = optics::longitudinal_aberration(lens, *first, wavelengths_of(lens), zones());
    facts.longitudinal_aberration = {lsa.zones, lsa.wavelengths_um, lsa.shift_mm};
    if (const Status status = add_field(facts, lens, *first); !status) return status.error();
    return facts;
}

}  // namespace

std::vector<LensSummary> matching(const std::vector<LensSummary>& lenses,
                                  const std::vector<std::string>& words) {
    const auto lower = [](std::string text) {
        for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
        return text;
    };
    std::vector<LensSummary> found;
    for (const LensSummary& lens : lenses) {
        std::string text = lens.name;
        for (const std::string& more : {lens.title, lens.kind, lens.year, lens.history}) text += "\n" + more;
        for (const std::string& name : lens.names) text += "\n" + name;
        text = lower(std::move(text));
        const auto is_there = [&](const std::string& word) {
            return text.find(lower(word)) != std::string::npos;
        };
        if (std::all_of(words.begin(), words.end(), is_there)) found.push_back(lens);
    }
    return found;
}

std::vector<LensSummary> in_order(std::vector<LensSummary> lenses, LensOrder order) {
    const auto number = [order](const LensSummary& lens) {
        const double size = order == LensOrder::FNumber ? lens.f_number : lens.focal_length_mm;
        return size > 0 ? size : INFINITY;
    };
    std::stable_sort(lenses.begin(), lenses.end(), [&](const LensSummary& a, const LensSummary& b) {
        if (order == LensOrder::Name) return a.name < b.name;
        if (order == LensOrder::Year)
            return (a.year.empty() ? "~" : a.year) < (b.year.empty() ? "~" : b.year);
        return order != LensOrder::Shelf && number(a) < number(b);
    });
    return lenses;
}

std::vector<LensSummary> lens_list() {
    std::vector<LensSummary> list{ideal_summary()};
    for (const std::string& name : kernel::curve_preset_names())
        list.push_back(summary_of(*kernel::curve_preset(name)));
    for (const lens_files::ShelfItem& item : lens_files::shelf()) {
        const auto file = lens_files::find_lens(std::string(item.name));
        if (!file) continue;  // the shelf's own test reads every one of them
        if (file->curves) {
            list.push_back(summary_of(*file->curves));
            continue;
        }
        const auto first = optics::first_order(file->lens, file->lens.primary_um);
        if (first) list.push_back(summary_of(file->lens, *first));
    }
    return list;
}

Result<std::optional<double>> widest_f_number(const Lens& lens) {
    if (lens.kind() == LensModelKind::Ideal) return std::optional<double>();
    const lens_files::LensFile& file = *lens.contents().file;
    if (lens.kind() == LensModelKind::Curves) return std::optional(file.curves->f_number);
    const auto first = optics::first_order(file.lens, file.lens.primary_um);
    if (!first) return Error{ErrorCode::InvalidFile, lens.name() + ": " + first.error().message};
    return std::optional(first->f_number);
}

Result<LensFacts> lens_facts(const Lens& lens) {
    const lens_files::LensFile& file = *lens.contents().file;
    LensFacts facts;
    switch (lens.kind()) {
        case LensModelKind::Ideal:
            facts.summary = ideal_summary();
            break;
        case LensModelKind::Curves:
            facts = facts_of(*file.curves);
            facts.summary.year = file.lens.year, facts.summary.history = file.lens.history;
            if (!file.format.empty()) facts.summary.source = file.lens.source;
            facts.format = file.format, facts.notes = file.lens.notes, facts.warnings = file.warnings;
            break;
        case LensModelKind::Prescription: {
            auto traced = facts_of(file);
            if (!traced) return Error{ErrorCode::InvalidFile, lens.name() + ": " + traced.error().message};
            return traced;
        }
    }
    return facts;
}

Result<LensFacts> lens_facts(const std::string& name_or_file) {
    LensChoice choice;
    choice.name = name_or_file;
    const auto lens = Lens::open(choice);
    if (!lens) return lens.error();
    return lens_facts(*lens);
}

}  // namespace petzval
