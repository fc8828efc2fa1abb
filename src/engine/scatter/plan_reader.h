// Reads the plans of a run of the scatter engine instead of its result.
#pragma once

#include "device/device.h"
#include "engine/lights/highlights.h"
#include "engine/lights/plan.h"
#include "engine/samples/complete.h"
#include "engine/scatter/plan.h"
#include "engine/scatter/scatter_kernels.h"

#include <vector>

namespace petzval::engine {

// All that a strip is drawn from.
struct PlannedStrip {
    const EngineView& input;
    const ScatterPlan& scatter;
    const ScatterKernels& kernels;
    const std::vector<Highlight>& highlights;
    const ShadowCasters& casters;
    const HighlightKernels& highlight_kernels;
    float white;
    const std::vector<Highlight>* asked_by = nullptr;  // see LightsPlanner
};

// Adds the highlights of a strip to `out`, the whole frame.
device::Work draw_lights(const PlannedStrip& strip, device::Target out);

// The frame is done as one strip.
class PlanReader {
public:
    virtual ~PlanReader() = default;
    // `strip` is what the plan is made from. False: nothing that follows is wanted.
    virtual bool read(const EngineView& strip, const CompletedPicture& completed) = 0;
    virtual void read(const PlannedStrip& strip) = 0;
};

}  // namespace petzval::engine
