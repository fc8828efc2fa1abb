// A lens and a camera for it, as verbs that draw discs ask for them.
#pragma once

#include "petzval/camera.h"

#include "flags/camera.h"
#include "flags/look_flags.h"
#include "flags/look_rows.h"

#include <optional>
#include <string>

namespace petzval::cli {

struct MountFlags {
    std::string lens_name;
    LookFlags look;
    CameraFlags camera;
    int width_px = 1920;
    std::optional<int> height_px;

    // idle: flags without effect in this verb.
    void add_lens_to(Verb& verb, const LookFlags::Idle& idle = {});
    // Throws UsageError.
    void check_lens(const Verb& verb);
};

std::string camera_text(const Camera& c);

}  // namespace petzval::cli
