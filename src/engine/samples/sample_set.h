// What the first stage leaves: everything that a lens may see, and which of it is one surface.
#pragma once

#include "engine/samples/dim.h"
#include "engine/waist/engine.h"

namespace petzval::engine {

struct SampleSet {
    CocSamples samples;  // complete (engine/samples/complete.h)
    Image<unsigned char>
        connected;  // of the pixels of what the picture shows (engine/samples/connectivity.h)
};

// `dim` empty: the picture shows no lamps.
SampleSet complete_samples(const Input& input, const Dim& dim = {});

}  // namespace petzval::engine
