#include "engine/samples/sample_set.h"

#include "engine/samples/complete.h"
#include "engine/samples/connectivity.h"

namespace petzval::engine {

SampleSet complete_samples(const Input& input, const Dim& dim) {
    SampleSet set;
    set.connected = connections(input.coc_px, *input.workers);
    set.samples = CompletedPicture(input, set.connected, dim).all();
    return set;
}

}  // namespace petzval::engine
