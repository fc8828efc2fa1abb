// Facts about lenses as text: lists, tables of numbers, comparisons with printed numbers.
#include "petzval/lens_facts.h"
#include "petzval/reports/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace petzval {
namespace {

// One line of a table, cut at 400 characters.
[[gnu::format(printf, 1, 2)]] std::string row(const char* format, ...) {
    std::array<char, 400> text{};
    std::va_list values;
    va_start(values, format);
    std::vsnprintf(text.data(), text.size(), format, values);
    va_end(values);
    return std::string(text.data()) + "\n";
}

// Text broken into lines of at most `width`, each behind `indent`. Works on bytes; UTF-8 is not split in
// words.
std::string wrapped(const std::string& text, const std::string& indent, std::size_t width = 96) {
    std::string out, line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        at = end + 1;
        if (!line.empty() && indent.size() + line.size() + 1 + word.size() > width) {
            out += indent + line + "\n";
            line.clear();
        }
        line.append(line.empty() ? "" : " ").append(word);
    }
    return line.empty() ? out : out + indent + line + "\n";
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::string first_order_text(const LensFacts& f) {
    std::string text;
    text += row("focal length       %12.6g mm    f-number           %12.6g", f.efl_mm, f.f_number);
    text += row("back focus         %12.6g mm    front focus        %12.6g mm", f.bfl_mm,
                f.front_focal_position_mm);
    text += row("entrance pupil at  %12.6g mm    its diameter       %12.6g mm", f.entrance_pupil_position_mm,
                f.entrance_pupil_diameter_mm);
    text += row("exit pupil at      %12.6g mm    its diameter       %12.6g mm", f.exit_pupil_position_mm,
                f.exit_pupil_diameter_mm);
    text += row("first to last glass%12.6g mm    Petzval radius     %12.6g mm", f.vertex_length_mm,
                f.petzval_radius_mm);
    text += row("format             %12.6g mm wide", f.sensor_width_mm);
    if (std::isfinite(f.object_distance_mm))
        text += row("object at          %12.6g mm    magnification      %12.6g", f.object_distance_mm,
                    f.magnification);
    return text + "(pupils: entrance from the first vertex, exit from the last, + towards the image)\n";
}

std::string seidel_text(const LensFacts& f) {
    std::string text = row("\nthird order, mm, at %.4g degrees and full aperture", f.seidel_field_deg);
    text += row("surface %11s %11s %11s %11s %11s %11s %11s", "S_I", "S_II", "S_III", "S_IV", "S_V", "C_I",
                "C_II");
    const auto line = [&](const std::string& label, const SeidelFacts& s) {
        text += row("%7s %11.6f %11.6f %11.6f %11.6f %11.6f %11.6f %11.6f", label.c_str(), s.s1, s.s2, s.s3,
                    s.s4, s.s5, s.c1, s.c2);
    };
    for (std::size_t i = 0; i < f.seidel_per_surface.size(); ++i)
        line(std::to_string(i + 1), f.seidel_per_surface[i]);
    line("sum", f.seidel);
    return text;
}

std::string longitudinal_text(const LongitudinalAberrationFacts& lsa) {
    if (lsa.zones.empty()) return "";
    std::string text =
        "\nfocus of each zone, mm from the paraxial one (negative is nearer the lens)\n   zone";
    for (const double um : lsa.wavelengths_um) {
        std::array<char, 32> heading{};
        std::snprintf(heading.data(), heading.size(), "%8.1f nm", um * 1000);
        text += heading.data();
    }
    text += "\n";
    for (std::size_t z = 0; z < lsa.zones.size(); ++z) {
        std::array<char, 32> cell{};
        std::snprintf(cell.data(), cell.size(), "%7.3g", lsa.zones[z]);
        text += cell.data();
        for (const auto& shifts : lsa.shift_mm) {
            std::snprintf(cell.data(), cell.size(), "%11.5f", shifts[z]);
            text += cell.data();
        }
        text += "\n";
    }
    return text;
}

// Replaces rounding errors around zero, and −0, by 0.
double clean(double value) { return std::abs(value) < 1e-9 ? 0 : value; }

std::string field_text(const std::vector<FieldFacts>& field) {
    if (field.empty()) return "";
    std::string text = "\nover the field, rays aimed at the stop, object at its distance, lens open\n";
    text += row("%8s %11s %12s %12s %12s %11s %10s", "degrees", "height mm", "tangential", "sagittal",
                "distortion %", "colour mm", "unvignetted");
    for (const FieldFacts& p : field)
        text += row("%8.3f %11.5g %12.5f %12.5f %12.4f %11.5f %9.1f %%", p.field_deg,
                    clean(p.image_height_mm), clean(p.tangential_focus_mm), clean(p.sagittal_focus_mm),
                    clean(p.distortion_percent), clean(p.lateral_colour_mm), 100 * p.unvignetted_share);
    return text;
}

// "focal length  50.02 mm  (printed 50 mm, +0.04 %)"
std::string beside(const std::string& label, double ours, double printed, const std::string& unit) {
    std::string text =
        label + std::string(label.size() < 14 ? 14 - label.size() : 1, ' ') + plain(ours, 5) + unit;
    if (printed > 0)
        text += "  (printed " + plain(printed, 6) + unit + ", " + (ours < printed ? "" : "+") +
                plain(100 * (ours / printed - 1), 2) + " %)";
    return text + "\n";
}

}  // namespace

std::string lens_list_text(const std::vector<LensSummary>& lenses) {
    std::string text;
    for (const LensSummary& lens : lenses) {
        const std::string size = lens.focal_length_mm > 0
                                     ? plain(lens.focal_length_mm, 4) + " mm f/" + plain(lens.f_number, 3)
                                     : "any";
        text += row("%-30s %-17s %-24s %s", lens.name.c_str(), size.c_str(), lens.kind.c_str(),
                    lens.year.c_str());
        text += wrapped(lens.title, "    ");
        if (!lens.names.empty()) text += wrapped("also: " + joined(lens.names), "    ");
    }
    return text;
}

std::string lens_facts_text(const LensFacts& facts) {
    const LensSummary& s = facts.summary;
    std::string text = s.name + ": " + s.title + (s.year.empty() ? "" : ", " + s.year) + "\n";
    if (!s.history.empty()) text += "\n" + wrapped(s.history, "");
    if (!s.source.empty()) text += "\nsource:\n" + wrapped(s.source, "  ");
    for (const std::string& remark : facts.notes) text += wrapped("note: " + remark, "  ");
    text += "\n";
    if (facts.has_prescription)
        text += first_order_text(facts) + seidel_text(facts);
    else if (facts.efl_mm > 0)
        text += row("drawn for %g mm f/%g", facts.efl_mm, facts.f_number);
    text += longitudinal_text(facts.longitudinal_aberration) + field_text(facts.field);
    return text;
}

std::string lens_check_text(const LensFacts& facts, const std::string& input) {
    std::string text = input + ": " + (facts.format.empty() ? "ships with petzval" : facts.format) + ", " +
                       std::to_string(facts.seidel_per_surface.size()) + " surfaces\n";
    text += beside("focal length", facts.efl_mm, facts.printed_efl_mm, " mm");
    text += beside("f-number", facts.f_number, facts.printed_f_number, "");
    const std::size_t guesses = facts.warnings.size() - facts.doubts.size();
    for (std::size_t i = 0; i < guesses; ++i) text += "assumed: " + facts.warnings[i] + "\n";
    for (const std::string& doubt : facts.doubts) text += "doubt: " + doubt + "\n";
    if (facts.doubts.empty()) text += "no doubts\n";
    return text;
}

}  // namespace petzval
