// Codes of a display, of a frame: as whoever asked for them wants them.
#pragma once

#include "petzval/session.h"

#include "device/device.h"

#include <cstdint>
#include <string>
#include <vector>

namespace petzval {

struct FrameCodes {
    std::vector<std::uint16_t> codes;
    std::string device;  // who made them: its name
};

// lies: where the picture's pixels lie in the frame. asked: those of them that are shown. The CPU makes what
// the device cannot. Throws what a device throws.
FrameCodes codes_of(device::Canvas& picture, const Rect& lies, const Rect& asked, const CodesWanted& wanted,
                    const device::Device& device, Workers& workers);

}  // namespace petzval
