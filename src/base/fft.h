// The discrete Fourier transform of pictures whose sides are powers of two (Cooley and Tukey, 1965).
//
// Sixteen rows or columns are transformed side by side, in SIMD.
#pragma once

#include "petzval/workers.h"

#include <complex>
#include <limits>
#include <vector>

namespace petzval {

inline constexpr int kLanes = 16;

// Twiddle factors for transforms of n = 2^k points.
class Fft {
public:
    explicit Fft(int n);
    int size() const { return n_; }

    // kLanes signals at once: point i of lane l is re[i * kLanes + l]. In place. Forward: exponent -i;
    // inverse: exponent +i, not divided by n.
    void transform(float* re, float* im, bool inverse) const;

private:
    int n_;
    std::vector<float> cos_, sin_;
    std::vector<int> swap_with_;  // bit-reversed index
};

// In place, `side` x `side` complex numbers, row by row. Inverse is divided by side^2. Columns farther than
// `reach` from column 0, around the end, may be left untransformed. Requires: side is a power of two and a
// multiple of kLanes.
void fft_square(std::vector<std::complex<float>>& field, const Fft& fft, bool inverse, Workers& workers,
                int reach = std::numeric_limits<int>::max());

}  // namespace petzval
