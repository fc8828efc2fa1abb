// `sheet --lenses`: one picture through several lenses.
#pragma once

#include "petzval/display_files.h"
#include "petzval/lens_report.h"

#include "flags/camera.h"
#include "flags/flags.h"
#include "flags/look_flags.h"
#include "flags/run_flags.h"
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
    // The sheet, display-linear; `sheet` holds what concerns the sheet alone.
    Result<Picture> make(const InputFlags& input, LensViewSheet sheet, const DisplayChoice& display,
                         const RunFlags& run);
};

}  // namespace petzval::cli
