// Flags of the lighter engines: gather, gaussian and sprites. Each belongs to one of them; given with another
// it is refused.
#pragma once

#include "petzval/defocus.h"
#include "petzval/result.h"

#include "defocus_views.h"
#include "flags.h"
#include "report.h"
#include "values.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct EngineOptionFlags {
    std::optional<GatherStage> gather_stage;
    std::optional<int> gather_taps;
    std::optional<bool> gather_extreme_coc, gather_fill;
    std::optional<GaussianStyle> gaussian_style;
    std::optional<double> focus_band, depth_offset, bright_factor;
    std::optional<Interval> depth_band_range_m;
    std::optional<SpriteBackground> background;
    std::optional<bool> find_points;
    std::string points;  // CSV file, or empty

    void add_to(Verb& verb);
    // Throws UsageError for flags that could have no effect with this engine and view.
    void check(const std::string& engine, ViewKind view) const;
    // Sets what the job's engine reads, all but the points themselves.
    void apply(DefocusJob& job, ViewKind view) const;
    Json json() const;  // those that were given
};

}  // namespace petzval::cli
