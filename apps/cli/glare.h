// Glare and falloff of a command: what `defocus` does after the blur and `develop` before the tone curve.
#pragma once

#include "petzval/glare.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include "flags.h"
#include "report.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct GlareFlags {
    std::optional<double> bloom, bloom_radius, star, star_radius, ghosts, veil, threshold;
    std::optional<StarQuality> star_quality;
    std::optional<LensCoating> coating;
    bool vignetting = false;

    void add_to(Verb& verb);
    // Throws UsageError for flags that would have no effect.
    void check(const LensChoice& lens) const;
    // Names of those given, for messages.
    std::vector<std::string> given() const;

    // Changes shot.colour; nothing if no flag was given. Camera numbers that are missing are an error only
    // where a part needs them. Errors: those of add_falloff and add_glare.
    Status apply(Shot& shot, const Lens& lens, int threads) const;
    Json json() const;  // null if no flag was given
};

}  // namespace petzval::cli
