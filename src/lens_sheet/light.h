// Light as the page shows it: colours of wavelengths, discs on black, pictures as data: URIs.
#pragma once

#include "petzval/image.h"

#include "colour/spectrum.h"
#include "kernel/model/lens_model.h"

#include <span>
#include <string>
#include <vector>

namespace petzval::lens_sheet {

// Spectral lines used for glass. Their class gives each a colour and a dash pattern.
struct SpectralLine {
    double wavelength_nm;
    const char* name;
    const char* css;
};
std::span<const SpectralLine> spectral_lines();  // g, F, e, d, C

// Divides the visible spectrum into that many slices; 3: red, green and blue, at the primaries of Rec.709.
std::vector<colour::SpectralBand> slices(int count);

// Colour of a slice of the spectrum on black: "rgb(255,120,0)". r, g, b: as in colour::SpectralBand.
std::string slice_colour(double r, double g, double b);

// Light of 1 is a well exposed disc; what is brighter rolls off towards white, hue kept.
Rgba exposed(Rgba light);

// A black picture on which discs are placed.
class Canvas {
public:
    Canvas(int width, int height) : light_(width, height) {}
    // The disc's source at pixel (x, y); what reaches outside of `cell` is cut off.
    struct Flip {
        bool left_right = false, up_down = false;
    };
    void add(const kernel::PointSpread& disc, int x, int y, double gain, const Rect& cell, Flip flip);
    void add(const kernel::PointSpread& disc, int x, int y, double gain, const Rect& cell) {
        add(disc, x, y, gain, cell, {});
    }
    View<Rgba> light() { return light_; }
    // After exposed() and the sRGB curve.
    std::string uri() const;

private:
    Picture light_;
};

// Brings a disc to the brightness that a flat disc of the same second moment would have at `level`.
double even_gain(const kernel::PointSpread& disc, double level = 0.4);

// A PNG of display codes 0…1, sRGB already in them, as "data:image/png;base64,…".
std::string picture_uri(View<const Rgba> codes);
std::string base64(const std::string& bytes);

}  // namespace petzval::lens_sheet
