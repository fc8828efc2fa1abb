// What the scatter engine decides before it draws: what goes where.
//
// A plan is of a strip: rows of the frame with those around them that can influence them. Rows in a plan
// count from the strip's first.
#pragma once

#include "engine/lights/highlight_spread.h"
#include "engine/lights/highlights.h"
#include "engine/samples/sample_set.h"
#include "engine/scatter/sources.h"
#include "engine/scatter/stamp_table.h"
#include "engine/waist/engine.h"

#include <vector>

namespace petzval::engine {

LevelRule level_rule(const Input& input);

// Made when first asked for; the same for every picture of this lens, size and quality.
struct ScatterKernels final : KeptKernels {
    ScatterKernels(const Input& input, const LevelRule& rule)
        : table(input, input.width(), input.height(), rule), highlights(input) {}
    StampTable table;
    HighlightKernels highlights;
};

struct ScatterPlan {
    Rect rows;          // pixels to be drawn
    int first_row = 0;  // row of the frame that is row 0
    LevelRule rule;
    CocSamples base;  // what was seen, less the highlights
    std::vector<Highlight> highlights;
    std::vector<SourceLevel> levels;
};

// Looks at what a run makes on its way, in place of its result. The frame is then done as one strip.
class PlanReader {
public:
    virtual ~PlanReader() = default;
    // `strip` is what the plan is made from. False: nothing that follows is wanted.
    virtual bool read(const Input& strip, const SampleSet& set) = 0;
    virtual void read(const Input& strip, const ScatterPlan& plan, const HighlightSplit& split,
                      const ScatterKernels& kernels) = 0;
};

}  // namespace petzval::engine
