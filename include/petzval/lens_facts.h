// Facts about lenses without a picture: the built-in lenses, and the numbers of any lens or lens file.
#pragma once

#include "petzval/export.h"
#include "petzval/lens.h"
#include "petzval/result.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval {

struct LensSummary {
    std::string name;                   // as --lens takes it
    std::string title;                  // one line
    std::string kind;                   // "triplet", "double gauss", …; may be empty
    std::string year, source, history;  // may be empty
    std::vector<std::string> names;     // other names that --lens accepts
    LensModelKind model = LensModelKind::Prescription;
    double focal_length_mm = 0, f_number = 0;  // as built (0: any); a lens may be scaled to any focal length
};

// Lenses that match every word, in their name, other names, title, kind, year or history, in any case.
PETZVAL_API std::vector<LensSummary> matching(const std::vector<LensSummary>& lenses,
                                              const std::vector<std::string>& words);

enum class LensOrder { Shelf, Name, Year, FocalLength, FNumber };
// The lenses in that order; Shelf: unchanged. Lenses without the number or year come last.
PETZVAL_API std::vector<LensSummary> in_order(std::vector<LensSummary> lenses, LensOrder order);

// Every lens that --lens knows by name: the ideal one, the curves, the prescriptions.
PETZVAL_API std::vector<LensSummary> lens_list();

// The smallest f-number of the lens; none for the ideal lens, which has no limit. Errors: those of
// lens_facts().
PETZVAL_API Result<std::optional<double>> widest_f_number(const Lens& lens);

// Third-order sums in mm, Welford's form; undercorrected spherical aberration has s1 > 0. c1, c2: axial and
// lateral colour between the short and the long wavelength.
struct SeidelFacts {
    double s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, c1 = 0, c2 = 0;
};

// Axis crossings of axial rays, from the paraxial focus of the primary wavelength; negative is nearer the
// lens.
struct LongitudinalAberrationFacts {
    std::vector<double> zones;  // share of the entrance pupil's radius
    std::vector<double> wavelengths_um;
    std::vector<std::vector<double>> shift_mm;  // [wavelength][zone]; NaN where no ray passes
};

// Real rays of one field angle, aimed at the stop; object at infinity, sensor in the paraxial focus.
struct FieldFacts {
    double field_deg = 0;
    double image_height_mm = 0;
    double tangential_focus_mm = 0,
           sagittal_focus_mm = 0;   // from the sensor, + away from the lens; NaN: no ray
    double distortion_percent = 0;  // against f tan(field); NaN from 89 degrees
    double lateral_colour_mm = 0;   // short minus long wavelength
    double unvignetted_share = 0;   // of the light through the stop
};

// Numbers of a prescription at its primary wavelength; lengths in mm, + towards the image. A lens of curves
// has only efl_mm, f_number, sensor_width_mm and longitudinal_aberration, and has_prescription false.
struct LensFacts {
    LensSummary summary;
    std::string format;  // of the file it was read from
    std::vector<std::string> notes, warnings;
    bool has_prescription = false;
    // Numbers printed beside the surfaces; 0: none.
    double printed_efl_mm = 0, printed_f_number = 0;
    // Reasons why the surfaces cannot be those that were printed: overlaps, thin edges, another focal
    // length or f-number. One sentence each; also the last of the warnings.
    std::vector<std::string> doubts;

    double efl_mm = 0, bfl_mm = 0, f_number = 0;
    double sensor_width_mm = 0;          // of the format it was made for: as stated, or of the 3:2 frame that
                                         // its field fills, or 0.72 focal lengths; 0 for the ideal lens
    double front_focal_position_mm = 0;  // from the first vertex
    double entrance_pupil_position_mm = 0, entrance_pupil_diameter_mm = 0;  // from the first vertex
    double exit_pupil_position_mm = 0, exit_pupil_diameter_mm = 0;          // from the last vertex
    double vertex_length_mm = 0, petzval_radius_mm = 0, lagrange_invariant_mm = 0;
    double object_distance_mm = 0;  // from the first vertex, infinity as a rule
    double image_distance_mm = 0;   // last vertex to the paraxial image of that object
    double magnification = 0;       // 0 for an object at infinity
    double field_deg = 0;           // largest half field
    double seidel_field_deg = 0;    // half field of the sums below
    double short_um = 0, primary_um = 0, long_um = 0;

    SeidelFacts seidel;
    std::vector<SeidelFacts> seidel_per_surface;
    bool seidel_complete = true;  // false: odd aspheric powers below 4, which these sums cannot describe
    LongitudinalAberrationFacts longitudinal_aberration;
    std::vector<FieldFacts> field;  // from the axis to field_deg, or until no ray passes the stop's centre
};

// Errors: InvalidFile for a file that describes no lens that forms an image.
PETZVAL_API Result<LensFacts> lens_facts(const Lens& lens);
// Errors: as above, and those of Lens::open().
PETZVAL_API Result<LensFacts> lens_facts(const std::string& name_or_file);

// The same facts as text for people, in lines of at most 96 columns as far as words allow; tables are wider.
// Names from a lens file are not made printable.
PETZVAL_API std::string lens_list_text(const std::vector<LensSummary>& lenses);
PETZVAL_API std::string lens_facts_text(const LensFacts& facts);
// Focal length and f-number beside the printed ones, assumptions and doubts. input: the name or file that
// the lens was opened by.
PETZVAL_API std::string lens_check_text(const LensFacts& facts, const std::string& input);

}  // namespace petzval
