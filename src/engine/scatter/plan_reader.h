// Looks at what a run of the scatter engine makes on its way, in place of its result.
#pragma once

#include "device/device.h"
#include "engine/lights/highlights.h"
#include "engine/lights/plan.h"
#include "engine/scatter/plan.h"
#include "engine/scatter/scatter_kernels.h"

#include <vector>

namespace petzval::engine {

// All that a strip is drawn from.
struct PlannedStrip {
    const Input& input;
    const ScatterPlan& scatter;
    const ScatterKernels& kernels;
    const CocSamples& base;  // what was seen, less the highlights
    const std::vector<Highlight>& highlights;
    const HighlightKernels& highlight_kernels;
    float white;
    const std::vector<Highlight>* asked_by = nullptr;  // see LightsPlanner
    const Image<unsigned char>* connected = nullptr;   // of the strip
};

// Adds the highlights of a strip to `out`, the whole frame.
device::Work draw_lights(const PlannedStrip& strip, View<Rgba> out);

// The frame is done as one strip.
class PlanReader {
public:
    virtual ~PlanReader() = default;
    // `strip` is what the plan is made from. False: nothing that follows is wanted.
    virtual bool read(const Input& strip, const SampleSet& set) = 0;
    virtual void read(const PlannedStrip& strip) = 0;
};

}  // namespace petzval::engine
