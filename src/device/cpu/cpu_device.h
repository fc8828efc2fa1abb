// The CPU as a device: the loops of device/cpu on the threads that it is given.
#pragma once

#include "device/device.h"

namespace petzval::device {

const Device& cpu_device();

}  // namespace petzval::device
