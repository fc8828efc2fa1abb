// Everything that spreads its light, sorted into layers and levels of detail.
//
// A source is a small square of one surface. Its LAYER (an interval of signed radius) says in which order it
// is composited; its LEVEL (cells 2^level pixels wide) says on which grid it is spread, so that no source
// covers more than a fixed number of cells in radius. Radii stay exact: neither layers nor levels quantise
// them.
#pragma once

#include "petzval/workers.h"

#include "engine/samples/sample_source.h"
#include "engine/scatter/plan.h"

namespace petzval::engine {

// Sources of all levels, 0 first. `samples` are complete (engine/samples/complete.h), and each row is asked
// for once, after which they are let go; coc_px is what the picture shows, and `connected` which of its
// pixels are one surface (engine/samples/silhouettes/connectivity.h), for the slopes.
std::vector<SourceArray> make_sources(SampleSource samples, View<const float> coc_px,
                                      View<const unsigned char> connected, const OpenEdges& open,
                                      const LevelRule& rule, const ScatterKernels& kernels, Workers& workers);

}  // namespace petzval::engine
