// A user's choice of a lens: its name, the shape of its aperture, and changes of its aberrations. Lens
// (petzval/lens.h) is made from it.
#pragma once

#include "petzval/image.h"
#include "petzval/light_spectrum.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace petzval {

// Polygon inscribed in the f-stop's circle; see docs/reference/lens-files.md.
struct ApertureShape {
    int blades = 0;           // 0: round; else >= 3
    double rotation_deg = 0;  // first vertex, counter-clockwise from +x, in the far (upright) disc
    double curvature = 0;     // 0 straight edges … 1 circle
    double squeeze = 1;       // height of the disc divided by its width, > 0
    // > 0: the f-number at which the iris is fully open and round; its blades straighten towards `curvature`
    // over the first stop and a half.
    double round_at_f_number = 0;

    bool operator==(const ApertureShape&) const = default;
};

// A circular rim of the barrel, a hood or a filter ring, in front of the entrance pupil (distance > 0) or
// behind.
struct BarrelRim {
    double radius_mm = 0, distance_mm = 0;

    bool operator==(const BarrelRim&) const = default;
};

// Coverage of the pupil by each door of a matte box, from its side, in pupil radii: 0 open, 1 half covered.
struct BarnDoors {
    double left = 0, right = 0, top = 0, bottom = 0;  // as seen in the far (upright) disc

    bool operator==(const BarnDoors&) const = default;
};

// Texture of the pupil; best visible in large discs. Strengths 0 (none) to 1.
struct PupilTexture {
    // Transmission 0…1 over the square around the f-stop's circle, upright as the far disc shows it; may be
    // null.
    std::shared_ptr<const Plane> image;
    double dust = 0, scratches = 0;
    double onion_rings = 0;  // turning marks of moulded aspheres
    std::uint64_t seed = 1;  // of the positions of dust, scratches and rings

    bool operator==(const PupilTexture&) const = default;
};

// A photographed or drawn disc, used unchanged instead of a lens; its circle fills the picture. Far:
// upright. Without `near`, discs in front of focus are the far one turned by 180 degrees.
struct KernelImages {
    std::shared_ptr<const Picture> far, near;  // both null: none

    bool operator==(const KernelImages&) const = default;
};

// Position of the sensor for a lens with spherical aberration or axial colour.
enum class FocusMode {
    Best,      // least mean square blur at this aperture, wavelengths weighted by luminance
    Paraxial,  // the focus of light at 587.56 nm near the axis
    Shift,     // focus_shift_mm behind that focus
};

// Aberrations of third order added to any lens, as the defocus-control ring of a portrait lens does. 0: none.
// Lengths along the axis: + away from the lens.
struct AddedAberrations {
    // Spherical aberration W040: the wavefront at the pupil's rim relative to its middle, in waves of
    // 587.56 nm. + is undercorrected: the rim focuses nearer to the lens, and discs have a bright ring in
    // front of focus and a soft one behind. Stated for at_f_number (0: the camera's own); it falls with the
    // fourth power of the aperture.
    double spherical_waves = 0, at_f_number = 0;
    double axial_colour_mm = 0;  // focus of blue (486 nm) relative to red (656 nm); linear in 1/wavelength^2
    double field_curvature_mm =
        0;  // focus of the corners relative to the middle; grows with the square of the field
    // Size of the blue image (486 nm) minus that of the red one (656 nm), in percent; 588 nm is unchanged.
    double lateral_colour_percent = 0;

    bool operator==(const AddedAberrations&) const = default;
};

// A lens and its options. Defaults: a perfect lens with a round aperture, which gives a flat disc.
struct LensChoice {
    std::string name = "ideal";  // a built-in lens (lens list) or the path of a lens file
    ApertureShape aperture;
    double cats_eye = 0;  // 0…1: a rim in front of the pupil displaced by -cats_eye * field, in pupil radii
    std::vector<BarrelRim> barrel;
    BarnDoors barn_doors;
    PupilTexture texture;
    KernelImages kernel_images;

    FocusMode focus_mode = FocusMode::Best;
    double focus_shift_mm = 0;  // FocusMode::Shift: + away from the lens
    // Factors on the lens's own aberrations, 1 as built, 0 none, -1 reversed.
    double spherical = 1, axial_colour = 1;  // of a curve lens
    double lateral_colour = 1;               // of a prescription: separation of colours off the axis
    AddedAberrations added;
    // Further third-order aberrations, off the axis (0: none). At full field, with the pupil's rim at
    // height h = 1/(2 f-number) focal lengths:
    double coma = 0;  // tail 3 * 0.02 * coma * h^2 focal lengths long, + outward
    double astigmatism =
        0;  // tangential focus 2 * 0.01 * astigmatism focal lengths beyond the sagittal: + swirls
    // Discs stretch by (1 + 3 d) along and (1 + d) across the field's direction, and defocus() moves the
    // picture with them: from r half diagonals to r (1 + d r^2). Channels other than colour and alpha are
    // not moved.
    double distortion = 0;
    // Spectrum of the picture's light. The sensor is focused for daylight.
    LightSpectrum light = LightSpectrum::Daylight;
    int wavelengths = 0;  // bands of the spectrum; 0: as many as the kernel needs to be smooth
    bool wave = false;    // diffraction: rings in discs of small sensors, spikes of blades; slow

    bool operator==(const LensChoice&) const = default;
};

}  // namespace petzval
