// The focus point drawn over the picture, moved by the pen. Needs the draw suite (OpenFX 1.5), no OpenGL.
#pragma once

#include "ofx.h"

namespace petzval::plugin {

int overlay_main(const char* action, const void* handle, ofx::PropertySet* in, ofx::PropertySet* out);

}  // namespace petzval::plugin
