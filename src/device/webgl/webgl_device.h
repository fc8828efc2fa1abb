// WebGL2 as a device: what a gather and its lights need is handed to the page, which draws it
// (web/lab/gather-pass.js). Compiled for the lens lab alone.
#pragma once

#include "device/device.h"

namespace petzval::device {

// Draws gather plans and lights with masks; everything else throws Failed. The picture that comes home is
// empty: it is on the page.
const Device& webgl_device();

}  // namespace petzval::device
