// Doubts whether a prescription can be ground and mounted: surfaces that cut each other, edges too thin.
#pragma once

#include "optics/prescription.h"

#include <string>
#include <vector>

namespace petzval::optics {

// An element thinner than this share of its diameter at its edge counts as too thin.
inline constexpr double kThinEdge = 0.01;

// One sentence each, surfaces counted from 1. Where a surface states no clear radius, the radius of the axial
// beam stands for it. Empty: no doubts, or the lens could not be traced.
std::vector<std::string> build_doubts(const Prescription& lens);

}  // namespace petzval::optics
