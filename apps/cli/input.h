// The input flags of a command: files, their meaning, and messages about them.
#pragma once

#include "petzval/depth.h"
#include "petzval/files.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include "flags/camera.h"
#include "flags/flags.h"
#include "flags/values.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

// A source that flags fill; empty means: detect and report.
struct InputFlags : ShotSource {
    std::optional<DepthKind> depth_kind;
    std::optional<Interval> depth_range;
    std::optional<double> unit_scale_m;
    std::optional<Transfer> transfer;

    void add_to(Verb& verb);           // IN, the layer and the view
    void add_depth_to(Verb& verb);     // all that says what depth is
    void add_transfer_to(Verb& verb);  // --transfer
    void add_others_to(Verb& verb);    // --behind, --merge, --holdout, --mask
    void add_layers_to(Verb& verb);    // --layers
    // Throws UsageError for depth flags that contradict each other.
    void check() const;
    bool depth_is_coc() const { return depth_kind == DepthKind::CocPx; }
    // The source of the shot, with the user's camera and at most the memory of the process.
    ShotSource source(const CameraFlags& user = {}) const;
};

// Memory that the system lets this process take (memory_limit()); 0: no limit. Messages then name that limit
// and not --max-memory.
std::size_t process_memory_bytes(int threads);

}  // namespace petzval::cli
