// For tests of later stages: the completed samples of a whole picture.
#pragma once

#include "engine/samples/complete.h"
#include "engine/samples/silhouettes/connectivity.h"

namespace petzval::engine {

struct SampleSet {
    CocSamples samples;              // complete (engine/samples/complete.h)
    Image<unsigned char> connected;  // of the pixels of what the picture shows
};

// `dim` empty: the picture shows no lamps.
inline SampleSet complete_samples(const EngineView& input, const Dim& dim = {}) {
    SampleSet set;
    set.connected = connections(input.samples.coc_px, *input.services.workers);
    set.samples = CompletedPicture(input, set.connected, dim).all();
    return set;
}

}  // namespace petzval::engine
