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

// Rows of output done together: each value that is read serves them all.
constexpr int kGatherRows = 4;

// A kernel cut into steps: one value read for each of kGatherRows rows of output, with the weight it has in
// each (0 where the kernel does not reach). Of output row y, a multiple of kGatherRows, step t reads
// in(x + offsets[t]) of row y. weights: kGatherRows per step, or where channels differ kGatherRows times four
// channels. Rows beyond height, up to a multiple of kGatherRows, are written too.
struct StepJob {
    const std::ptrdiff_t* offsets;
    const float* weights;
    int steps;
    bool neutral;  // channels do not differ
    int width, height;
    std::ptrdiff_t in_stride, out_stride;
};

// Two planes at once; `channel` 0…3 says whose weights a plane takes.
void gather_two(const StepJob& job, const TapPlane& a, int channel_a, const TapPlane& b, int channel_b);

}  // namespace petzval::engine
