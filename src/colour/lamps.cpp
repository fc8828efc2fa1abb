#include "colour/lamps.h"

#include <cmath>

namespace petzval::colour {
namespace {

// A line: wavelength in air, statistical weight times transition probability (1/s) and the energy of its
// upper level (eV). A. Kramida, Yu. Ralchenko, J. Reader, NIST ASD team, NIST Atomic Spectra Database.
struct Transition {
    double wavelength_nm, weighted_rate, upper_ev;
};
// Levels are filled as at this temperature, which gives the ratios of a thin discharge; those of a real lamp
// depend on its pressure.
constexpr double kTemperature_ev = 1;

constexpr Transition kSodium[] = {{588.995, 2.46e8, 2.104}, {589.592, 1.23e8, 2.102}};
constexpr Transition kMercury[] = {{404.657, 6.21e7, 7.7305},
                                   {435.834, 1.7e8, 7.7305},
                                   {546.075, 1.5e8, 7.7305},
                                   {576.961, 1.18e8, 8.8520},
                                   {579.067, 1.6e8, 8.8442}};
constexpr Transition kNeon[] = {
    {540.056, 9.00e5, 18.9660}, {585.249, 6.15e7, 18.9660}, {588.190, 3.45e7, 18.7264},
    {594.483, 5.65e7, 18.7041}, {597.553, 1.05e7, 18.6934}, {603.000, 1.68e7, 18.7264},
    {607.434, 6.03e7, 18.7114}, {609.616, 9.05e7, 18.7041}, {614.306, 1.41e8, 18.6368},
    {616.359, 4.38e7, 18.7264}, {621.728, 1.91e7, 18.6127}, {626.650, 7.47e7, 18.6934},
    {633.443, 8.05e7, 18.5758}, {638.299, 9.63e7, 18.6127}, {640.225, 3.604e8, 18.5551},
    {650.653, 1.50e8, 18.5758}, {659.895, 6.96e7, 18.7264}, {667.828, 1.16e8, 18.7041},
    {692.947, 8.70e7, 18.6368}};

std::vector<LampLine> thin(std::span<const Transition> transitions) {
    std::vector<LampLine> lines;
    for (const Transition& t : transitions)
        lines.push_back(
            {t.wavelength_nm, t.weighted_rate / t.wavelength_nm *
                                  std::exp((transitions[0].upper_ev - t.upper_ev) / kTemperature_ev)});
    return lines;
}

double bell(double wavelength_nm, double middle_nm, double half_width_nm) {
    const double x = (wavelength_nm - middle_nm) / half_width_nm;
    return std::exp2(-x * x);
}

}  // namespace

std::vector<LampLine> lines_of(LightSpectrum light) {
    switch (light) {
        case LightSpectrum::Sodium:
            return thin(kSodium);
        case LightSpectrum::Mercury:
            return thin(kMercury);
        case LightSpectrum::Neon:
            return thin(kNeon);
        case LightSpectrum::Daylight:
        case LightSpectrum::Led:
            break;
    }
    return {};
}

// Drawn, not measured: a blue diode 20 nm wide at 450 nm, a phosphor 130 nm wide at 560 nm.
double led_power(double wavelength_nm) {
    return bell(wavelength_nm, 450, 10) + 0.55 * bell(wavelength_nm, 560, 65);
}

}  // namespace petzval::colour
