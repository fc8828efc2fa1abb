// Joins the ends of hidden outlines.
#pragma once

#include "engine/samples/outlines/hidden_outlines.h"

namespace petzval::engine {

// Two ends on one line or arc become one outline; each other end continues alone.
std::vector<HiddenOutlines::Outline> joined_outlines(View<const float> coc_px, std::vector<OutlineEnd> ends,
                                                     Workers& workers);

}  // namespace petzval::engine
