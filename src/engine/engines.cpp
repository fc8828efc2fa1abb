#include "engine/engine.h"

namespace petzval::engine {

std::span<const Engine> engines() {
    static constexpr Engine kEngines[] = {
        {"scatter", "final frames: every pixel spreads its own kernel, in depth order", run_scatter},
        {"reference", "the definition of a correct result, traced through the lens; slow", run_reference},
    };
    return kEngines;
}

}  // namespace petzval::engine
