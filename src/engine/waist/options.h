// Choices of an engine: those all engines understand, and its own options.
#pragma once

#include "petzval/engine_options.h"

#include <cstdint>
#include <variant>

namespace petzval::engine {

class PlanReader;  // engine/scatter/plan_reader.h

struct ScatterOwn {
    PlanReader* plan_reader = nullptr;  // looks at the plan in place of a result; null: nobody
};
struct GatherOwn {
    GatherOptions gather;
    SpriteOptions lights;  // bright points that are drawn as a whole
};
struct GaussianOwn {
    GaussianOptions gaussian;
};
struct SpritesOwn {
    SpriteOptions lights;
    GatherOptions gather;  // of the engine that draws what is behind the lights
    GaussianOptions gaussian;
};
struct ReferenceOwn {
    int pupil_points = 4096;
    std::uint64_t seed = 1;
};

struct EngineOptions {
    Quality quality = Quality::Standard;
    Fill fill = Fill::Full;
    std::variant<std::monostate, ScatterOwn, GatherOwn, GaussianOwn, SpritesOwn, ReferenceOwn> own = {};

    // Those of an engine, as they are where nothing was chosen unless it is the one that runs.
    template <typename Own>
    const Own& of() const {
        static const Own kAsUsual{};
        const Own* const held = std::get_if<Own>(&own);
        return held ? *held : kAsUsual;
    }
    // Light options of engines gather and sprites.
    const SpriteOptions& lights() const {
        return std::holds_alternative<SpritesOwn>(own) ? of<SpritesOwn>().lights : of<GatherOwn>().lights;
    }
};

}  // namespace petzval::engine
