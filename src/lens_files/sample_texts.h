// One lens written out in every format, for tests: what a program would have saved.
#pragma once

#include "lens_files/text.h"
#include "optics/prescription.h"

#include <cmath>
#include <string>

namespace petzval::lens_files {

inline std::string digits(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}

inline std::string glass_name(const optics::Glass& glass) { return glass.is_air() ? "" : glass.name; }

// Requires: glass from the catalogue, EPD, field angle, no asphere with odd powers.
inline std::string as_zmx(const optics::Prescription& lens) {
    std::string text =
        "VERS 140730 73 26155\nMODE SEQ\nNAME " + lens.name + "\nUNIT MM X W X CM MR CPMM\nENPD " +
        digits(lens.aperture) + "\nFTYP 0 0 2 3 0 0 0\nXFLN 0 0 0 0\nYFLN 0 " + digits(lens.field) +
        " 0 0\nWAVM 1 " + digits(lens.short_um) + " 1\nWAVM 2 " + digits(lens.primary_um) + " 1\nWAVM 3 " +
        digits(lens.long_um) +
        " 1\nWAVM 4 0.55 1\nPWAV 2\nSURF 0\n  TYPE STANDARD\n  CURV 0.0 0 0 0 0 \"\"\n  DISZ INFINITY\n";
    int index = 1;
    for (const optics::Surface& s : lens.surfaces) {
        text += "SURF " + std::to_string(index) + "\n";
        if (index - 1 == lens.stop) text += "  STOP\n";
        text += s.asphere.empty() ? "  TYPE STANDARD\n" : "  TYPE EVENASPH\n";
        text += "  CURV " + digits(s.curvature_per_mm) + " 0 0 0 0 \"\"\n  HIDE 0 0 0\n  SLAB 3\n";
        for (const auto& term : s.asphere)
            text += "  PARM " + std::to_string(term.power / 2) + " " + digits(term.coefficient) + "\n";
        text += "  DISZ " + digits(s.thickness_mm) + "\n";
        if (!s.after.is_air()) text += "  GLAS " + s.after.name + " 0 0 1.5 4.0E+1 0 0 0 0 0 0\n";
        if (s.conic != 0) text += "  CONI " + digits(s.conic) + "\n";
        if (std::isfinite(s.clear_radius_mm))
            text += "  DIAM " + digits(s.clear_radius_mm) + " 1 0 0 1 \"\"\n";
        ++index;
    }
    return text + "SURF " + std::to_string(index) +
           "\n  TYPE STANDARD\n  CURV 0.0\n  DISZ 0\nTOL TOFF 0 0\nEFLY 1 12\n";
}

inline std::string as_seq(const optics::Prescription& lens) {
    std::string text = "RDM;LEN  \"VERSION: 10.7\"\nTITLE '" + lens.name + "'\nEPD   " +
                       digits(lens.aperture) + "\nDIM   M\nWL    " + digits(1000 * lens.long_um) + " " +
                       digits(1000 * lens.primary_um) + " &\n  " + digits(1000 * lens.short_um) +
                       " ! nanometres\nREF   2\nXAN   0.0 0.0\nYAN   0.0 " + digits(lens.field) +
                       "\nSO    0.0 0.1e14\n";
    int index = 0;
    for (const optics::Surface& s : lens.surfaces) {
        const double radius = s.curvature_per_mm == 0 ? 0 : 1 / s.curvature_per_mm;
        std::string glass;
        for (const char c : glass_name(s.after))
            if (c != '-') glass += c;
        text += "S " + digits(radius) + " " + digits(s.thickness_mm) + " " + glass + "\n";
        if (index++ == lens.stop) text += "  STO\n";
        if (!s.asphere.empty() || s.conic != 0) text += "  ASP; K " + digits(s.conic) + "\n";
        for (const auto& term : s.asphere)
            text +=
                std::string("  ") + "ABCDEFGHJ"[term.power / 2 - 2] + " " + digits(term.coefficient) + "\n";
        if (std::isfinite(s.clear_radius_mm))
            text += "  CIR " + digits(s.clear_radius_mm) + "\n  CCY 0; THC 0\n";
    }
    return text + "SI 0.0 0.0\nGO\n";
}

// The lens as pbrt text, without dispersion, which the format cannot hold. Requires: an air stop on a
// separate plane, spheres only.
inline std::string as_pbrt(const optics::Prescription& lens) {
    std::string text = "# " + lens.name + "\n# radius\tsep\tn\taperture\n";
    int index = 0;
    for (const optics::Surface& s : lens.surfaces) {
        const bool stop = index++ == lens.stop;
        text += (s.curvature_per_mm == 0 ? "0" : digits(1 / s.curvature_per_mm)) + "\t" +
                digits(s.thickness_mm) + "\t" + (stop ? "0" : digits(s.after.index(optics::kLineD_um))) +
                "\t" + digits(2 * s.clear_radius_mm) + "\n";
    }
    return text;
}

inline std::string as_optical_bench(const optics::Prescription& lens) {
    std::string text = "[descriptive data]\ntitle\t" + lens.name +
                       "\n[constants]\n[variable distances]\nF-Number\t" + digits(lens.aperture) +
                       "\nAngle of View\t" + digits(2 * lens.field) + "\nd0\tInfinity\nBf\t" +
                       digits(lens.surfaces.back().thickness_mm) + "\n[lens data]\n";
    std::string aspheres;
    for (std::size_t i = 0; i < lens.surfaces.size(); ++i) {
        const optics::Surface& s = lens.surfaces[i];
        const std::string id = std::to_string(i + 1);
        const std::string radius = s.curvature_per_mm == 0 ? "Infinity" : digits(1 / s.curvature_per_mm);
        text += id + "\t" + (int(i) == lens.stop ? "AS" : radius) + "\t" +
                (i + 1 == lens.surfaces.size() ? "Bf" : digits(s.thickness_mm)) + "\t" +
                (s.after.is_air() ? "" : digits(s.after.index(optics::kLineD_um))) + "\t" +
                digits(2 * s.clear_radius_mm) + "\t" +
                (s.after.is_air() ? "" : digits(s.after.abbe_number()) + "\t" + s.after.name) + "\n";
        if (s.asphere.empty()) continue;
        aspheres.append(id).append("\t").append(radius).append("\t").append(digits(s.conic));
        for (const auto& term : s.asphere) aspheres.append("\t").append(digits(term.coefficient));
        aspheres.append("\n");
    }
    return text + "[aspherical data]\n" + aspheres + "[notes]\nanything goes here\n";
}

inline std::string as_utf16(const std::string& ascii, bool little_endian, bool with_mark) {
    std::string out = !with_mark ? "" : little_endian ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : ascii) {
        if (little_endian)
            out += c, out += '\0';
        else
            out += '\0', out += c;
    }
    return out;
}

}  // namespace petzval::lens_files
