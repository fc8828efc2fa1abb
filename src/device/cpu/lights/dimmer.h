// Factors for the kernel of a partly hidden light: the visible share of the pupil's grid at the origin of
// each weight.
#pragma once

#include "device/cpu/stamp.h"
#include "engine/lights/plan.h"

#include <bitset>
#include <vector>

namespace petzval::device {

// Serves one kernel at a time. A row of the grid has one of 256 patterns; each pattern is laid out over the
// kernel's width when a light first has it.
class Dimmer {
public:
    // radius: of the kernel, signed, in its cells. `kernel` must outlive the result of rows().
    void use(const engine::StampKernel& kernel, float radius, float pixel_aspect);
    // A row for each of the kernel's, valid until the next call.
    const engine::DimmedRow* rows(const engine::PupilMask& mask);

private:
    // The two points of the pupil's grid around a place of its square, clamped to the grid.
    struct Between {
        int cell;
        float share;  // of the second
        explicit Between(float place);
    };
    const float* shares_of(std::uint8_t seen);

    std::vector<Between> columns_, lines_;
    Picture shares_;  // row i: those of the grid's row whose bits are i
    std::bitset<256> made_;
    std::vector<engine::DimmedRow> rows_;
};

}  // namespace petzval::device
