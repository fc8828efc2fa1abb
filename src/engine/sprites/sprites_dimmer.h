// What a kernel of a light that is partly hidden is multiplied by: the share of the pupil's grid seen at the
// place each of its weights comes from.
#pragma once

#include "device/cpu/stamp.h"
#include "engine/sprites/sprites_shadow.h"

#include <bitset>
#include <vector>

namespace petzval::engine {

// Made for one kernel at a time: a row of the grid is one of 256, and each is laid out over the kernel's
// width when a light first has it.
class Dimmer {
public:
    // radius: of the kernel, signed, in its cells. `kernel` outlives what rows() returns.
    void use(const StampKernel& kernel, float radius, float pixel_aspect);
    // A row for each of the kernel's, valid until the next call.
    const DimmedRow* rows(const PupilMask& mask);

private:
    const float* shares_of(std::uint8_t seen);

    std::vector<PupilMask::Between> columns_, lines_;
    Picture shares_;  // row i: those of the grid's row whose bits are i
    std::bitset<256> made_;
    std::vector<DimmedRow> rows_;
};

}  // namespace petzval::engine
