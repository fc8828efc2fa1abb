// Ghosts: every bright spot thrown again, as shapes of the aperture, by light that was reflected on its way
// through the lens.
#pragma once

#include "petzval/glare.h"
#include "petzval/workers.h"

#include "kernel/model/coverage.h"
#include "optics/prescription.h"

#include <functional>
#include <vector>

namespace petzval::glare {

// One ghost of one light: evenly filled. Pixels from the middle of the frame, y down.
struct GhostShape {
    std::vector<kernel::Point> outline;  // convex
    kernel::Light share;                 // of the light that ghosts take, per channel
};

// All ghosts of a light at `source_px` from the middle of the frame. Their shares sum to 1, or to 0 where
// the lens throws none.
using GhostModel = std::function<std::vector<GhostShape>(kernel::Point source_px)>;

// Copies on the line through the middle: table in ghosts.cpp. height_px: of the frame.
GhostModel sprite_ghosts(const ApertureShape& aperture, double height_px, double pixel_aspect);

// Paraxial ghosts of a prescription; see prescription_ghosts.cpp. width_px: of the frame.
Result<GhostModel> prescription_ghosts(const optics::Prescription& lens, const GlareSettings& settings,
                                       int width_px);

// The ghosts of `light`. middle: of the frame, in pixels of the view.
Picture ghosts_of(View<const Rgba> light, const GhostModel& model, kernel::Point middle, Workers& workers);

}  // namespace petzval::glare
