// What a lens leaves uncorrected, what cuts its beams and what lies in its pupil: the flags beyond name and
// blades.
#pragma once

#include "petzval/lens_choice.h"
#include "petzval/result.h"

#include "flags.h"
#include "report.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct LensCharacterFlags {
    std::optional<FocusMode> focus_mode;
    std::optional<double> focus_shift_mm, spherical, axial_colour, lateral_colour, coma, astigmatism,
        distortion;
    std::optional<double> iris_open, dust, scratches, onion_rings;
    std::optional<std::uint64_t> texture_seed;
    std::optional<int> wavelengths;
    std::vector<BarrelRim> barrel;
    std::optional<BarnDoors> barn_doors;
    std::string aperture_image;
    std::vector<std::string> kernel_images;  // far, near
    bool wave = false;

    void add_to(Verb& verb);
    // Throws UsageError for flags that would have no effect on the lens of that name.
    void check(const std::string& lens, bool has_blades) const;
    // Files that are read.
    std::vector<std::string> input_files() const;
    // Reads the images. Errors: those of read_png and read_frame.
    Status load(int threads);
    // Requires: load() has been called if there are images.
    void apply_to(LensChoice& lens) const;

private:
    std::shared_ptr<const Plane> aperture_;
    KernelImages kernels_;
};

// The same as they were used, for reports.
Json character_json(const LensChoice& lens);

}  // namespace petzval::cli
