// Pictures of the scatter engine's intermediate results, read from the plan of the current run.
#pragma once

#include "petzval/deep.h"
#include "petzval/engine_options.h"
#include "petzval/engine_report.h"

#include "engine/scatter/plan_reader.h"

#include <memory>
#include <string>
#include <vector>

namespace petzval::views {

// Several pictures in one; panels say where each lies.
struct Shown {
    Picture image;
    std::vector<Panel> panels;
    std::vector<std::string> warnings;
    DeepPicture hidden;  // depths are radii
};

// Most bytes a pixel that a view and the run it looks at take.
constexpr std::size_t kBytesPerPixel = 260;

class PlanView : public engine::PlanReader {
public:
    bool read(const engine::EngineView&, const engine::CompletedPicture&) override { return true; }
    void read(const engine::PlannedStrip&) override {}
    Shown take() { return std::move(shown_); }

protected:
    Shown shown_;
};

// Null for the result itself.
std::unique_ptr<PlanView> plan_view(ScatterView view);
const char* name_of(ScatterView view);

// A row of panels for the nearest sample of every pixel, the next one behind it and so on: left its light,
// premultiplied by the share of the pixel that it takes up, right the number of the depth layer in which it
// is composited: 0 about focus, negative in front. Samples that hold no light are left out. At most four
// rows; a warning says if there is more.
class LayersView final : public PlanView {
public:
    bool read(const engine::EngineView& input, const engine::CompletedPicture& completed) override;
};

// All surfaces of every pixel, nearest first; over one another they are the picture. Light of lamps stands on
// the surface that shows it.
class HiddenView final : public PlanView {
public:
    bool read(const engine::EngineView& input, const engine::CompletedPicture& completed) override;
};

// Level 0 at the top left, highlights right of it; below, the reduced levels side by side, and a map of which
// level drew what at half size.
//
// After HexaDrive's demo of 2009 (docs/explain/published.md), which let its vertex shader shift every
// sprite to the part of one large buffer that belongs to its level. The accumulations are shown before they
// are composited: light of all depths added up, alpha the lens area it takes up (above 1 where several
// surfaces send light).
class LevelsView final : public PlanView {
public:
    using PlanView::read;
    void read(const engine::PlannedStrip& strip) override;
};

// Left the highlights as they are drawn, each with its whole kernel: the result less these is what the levels
// drew. Right the same light where it was taken out of the sharp picture; its alpha is 1 where some was.
class HighlightsView final : public PlanView {
public:
    using PlanView::read;
    void read(const engine::PlannedStrip& strip) override;
};

}  // namespace petzval::views
