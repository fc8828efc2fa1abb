// What the first stage leaves: everything that a lens may see, and which of it is one surface.
#pragma once

#include "engine/waist/engine.h"

#include <functional>

namespace petzval::engine {

struct SampleSet {
    CocSamples samples;  // complete (engine/samples/complete.h)
    Image<unsigned char>
        connected;  // of the pixels of what the picture shows (engine/samples/connectivity.h)
};

// `dim`: what a pixel of input.colour shows without lamps (LitPicture::dim_at); empty: it shows none.
SampleSet complete_samples(const Input& input, const std::function<Rgba(int, int)>& dim = {});

}  // namespace petzval::engine
