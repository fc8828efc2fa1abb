// A picture convolved with a large kernel, by fast Fourier transforms of overlapping tiles (T. G. Stockham,
// High-speed convolution and correlation, 1966: overlap-add). Memory depends on the kernel's size alone.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "kernel/model/lens_model.h"

#include <cstddef>
#include <vector>

namespace petzval::glare {

// A kernel as pictures are convolved with it: the transform of each channel, real as the kernel is symmetric.
struct Filter {
    int reach = 0;  // px to every side
    int size = 0;   // points a side of its transforms
    std::vector<float> r, g, b;
    std::size_t bytes() const { return 3 * r.size() * sizeof(float); }
};

// Points a side of the transforms for a kernel that reaches so far, and pictures of this size.
int transform_size(int reach, int width, int height);

// Requires: kernel(-x) = kernel(x), odd sides around 0; 2 * reach < size.
Filter filter_of(const kernel::PointSpread& kernel, int size, Workers& workers);

// out += amount * (light convolved with the kernel), r, g, b only. Tiles without light cost nothing; what
// falls outside the picture is dropped. Requires: both of one size.
void add_convolved(View<Rgba> out, View<const Rgba> light, const Filter& filter, float amount,
                   Workers& workers);

}  // namespace petzval::glare
