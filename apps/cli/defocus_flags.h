// The flags of `defocus`: what may be said, what contradicts, and the job they make.
#pragma once

#include "petzval/camera.h"
#include "petzval/defocus.h"

#include "camera.h"
#include "defocus_views.h"
#include "engine_options.h"
#include "flags.h"
#include "glare.h"
#include "input.h"
#include "lens.h"
#include "ocio.h"
#include "output.h"
#include "plate.h"
#include "report.h"
#include "run_flags.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

constexpr int kAutomatic = 0;

struct DefocusFlags {
    InputFlags input;
    PlateFlags plate;
    CameraFlags camera;
    FocusFlags focus;
    LensFlags lens;
    GlareFlags glare;
    std::string engine = "scatter";
    EngineOptionFlags engine_options;
    Quality quality = Quality::Standard;
    std::optional<int> pupil_points;
    std::size_t max_memory_bytes = 0;
    std::uint64_t seed = 1;
    std::optional<std::string> kernel_cache;  // a folder, or "off"
    std::string output;
    ViewKind view = ViewKind::Beauty;
    std::optional<int> overscan_px;  // kAutomatic: as far as the blur reaches
    DevelopFlags develop;
    OcioFlags ocio;
    OverwriteFlags overwrite;
    RunFlags run;

    void add_to(Verb& verb);
    void check(const Verb& verb);  // throws UsageError for what is missing or contradicts
    std::vector<std::string> input_files() const;
    static std::string default_kernel_cache();
    // The job with what the flags choose.
    DefocusJob job(DefocusJob rendered) const;
    // Those that the report has no other place for.
    Json parameters_json(const DefocusJob& job) const;

private:
    void add_engine_to(Verb& verb);
    void add_output_to(Verb& verb);
    void check_coc_input() const;
    void check_view() const;
    void check_display() const;
};

}  // namespace petzval::cli
