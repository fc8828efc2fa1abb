// `sheet --lenses`: one picture through several lenses.
#pragma once

#include "petzval/lens_report.h"

#include "flags/camera.h"
#include "flags/flags.h"
#include "flags/look_flags.h"
#include "input.h"

#include <string>
#include <vector>

namespace petzval::cli {

struct LensesOnPictureFlags {
    std::vector<std::string> lenses;
    CameraFlags camera;
    FocusFlags focus;
    LookFlags look;

    void add_to(Verb& verb, InputFlags& input);
    bool is_on() const { return !lenses.empty(); }
    // Throws UsageError for contradictions, and for flags of a blur where there are no lenses.
    void check(const Verb& verb, InputFlags& input);
    // All that concerns the picture and its lenses, and not the sheet.
    LensViewFile file(const InputFlags& input) const;
};

}  // namespace petzval::cli
