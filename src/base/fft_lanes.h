// Loops of fft.cpp in SIMD. `re` and `im` hold kLanes signals: point i of lane l is at i * kLanes + l.
#pragma once

#include <cstddef>

namespace petzval {

struct FftTurns {
    int n = 0;
    const float *cos = nullptr, *sin = nullptr;  // of 2 pi k / n, k < n/2
    float sign = -1;                             // of the exponent
};

// Transforms signals whose points are in bit-reversed order.
void fft_stages(const FftTurns& turns, float* re, float* im);

// These read and write kLanes columns of a field of n x n complex numbers; `field` is the top of the first
// column. take_columns() returns true if a number is not 0.
bool take_columns(const float* field, std::size_t n, float* re, float* im);
void put_columns(const float* re, const float* im, std::size_t n, float scale, float* field);

}  // namespace petzval
