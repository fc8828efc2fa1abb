// A file's headers as JSON.
#pragma once

#include "petzval/files.h"

#include <string>

namespace petzval::c {

// Requires: the frame was read by read_frame_header().
std::string inspection_text(const Frame& frame);

}  // namespace petzval::c
