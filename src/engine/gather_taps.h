// The inner loop of gathering, for the instructions of this machine: planes of light summed under the taps of
// one kernel. gather_taps_simd.cpp is compiled once per instruction set, scalar included.
#pragma once

#include <cstddef>

namespace petzval::engine {

// Widths are rounded up to this: whole registers are read and written.
constexpr int kGatherGroup = 16;

// One plane in and one out; strides in floats.
struct TapPlane {
    const float* in;
    float* out;
};

// out(x, y) = sum over t of weights[t] * in(x + offsets...): offsets are in elements of the input's memory.
// A channel's weights lie `weight_step` floats apart. width is a multiple of kGatherGroup.
struct TapJob {
    const std::ptrdiff_t* offsets;
    const float* weights;
    int taps, weight_step;
    int width, height;
    std::ptrdiff_t in_stride, out_stride;
};

void gather_one(const TapJob& job, const TapPlane& plane);
// Four planes; plane k has its weights at job.weights + k * (0 if neutral, else 1).
void gather_four(const TapJob& job, const TapPlane planes[4], bool neutral);

}  // namespace petzval::engine
