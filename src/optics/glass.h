// Glass: refractive index against wavelength, and how much light a thickness of it lets through.
//
// Formulas (w = wavelength in micrometres, indices relative to air as makers publish them):
//   Sellmeier     n^2 = constant + sum_i B_i w^2 / (w^2 - C_i)      Schott; Zemax AGF formula 2
//   PowerSeries   n^2 = sum_j a_j w^p_j                             old Schott, Hikari; AGF formula 1
//   Abbe          n = A + B / w^2 through (nd, Vd): B = (nd - 1)/(Vd (1/wF^2 - 1/wC^2)), A = nd - B/wd^2
//   Constant      n = constant: the source knows no dispersion
// The Abbe model has no realistic secondary spectrum (n_g of a flint is wrong by about 1e-3), so it is the
// last resort and readers of lens files warn when they use it.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace petzval::optics {

// Spectral lines, micrometres.
inline constexpr double kLineG_um = 0.4358343, kLineF_um = 0.4861327, kLineE_um = 0.546074;
inline constexpr double kLineD_um = 0.5875618, kLineC_um = 0.6562725;

enum class Dispersion { Constant, Abbe, Sellmeier, PowerSeries };

// Share of light left after 10 mm of glass, without surface reflections.
struct TransmittanceSample {
    double wavelength_nm = 0, share = 1;
};

struct Glass {
    std::string name = "air";  // as its catalogue or file spells it
    std::string maker, source;
    Dispersion formula = Dispersion::Constant;
    double constant = 1;
    std::vector<std::array<double, 2>> terms;        // {B, C} | {a, p} | {A, B}, see above
    double range_low_um = 0, range_high_um = 0;      // where the formula was fitted; 0, 0: not stated
    std::vector<TransmittanceSample> transmittance;  // by rising wavelength; may be empty

    // NaN where the formula has no real value.
    double index(double wavelength_um) const;
    // Share left after path_mm, linear between samples; 1 where the catalogue says nothing.
    double internal_transmittance(double wavelength_nm, double path_mm) const;
    bool is_air() const { return formula == Dispersion::Constant && constant == 1; }
    // (nd - 1)/(nF - nC); infinity without dispersion.
    double abbe_number() const;
};

Glass constant_glass(std::string name, double index);
Glass abbe_glass(std::string name, double nd, double vd);

// The name as catalogues of different programs agree on it: upper case, letters and digits only
// (N-BK7, NBK7 and n_bk7 are one glass; SK16 and N-SK16 are two).
std::string normalised_glass_name(const std::string& name);

class GlassCatalogue {
public:
    void add(Glass glass);
    // nullptr when there is none of that name. A later glass of a name hides an earlier one.
    const Glass* find(const std::string& name) const;
    // Up to three names that a person may have meant, nearest first.
    std::vector<std::string> similar_names(const std::string& name) const;
    const std::vector<Glass>& glasses() const { return glasses_; }

private:
    std::vector<Glass> glasses_;
};

}  // namespace petzval::optics
