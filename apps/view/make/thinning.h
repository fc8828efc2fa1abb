// Fewer pixels, for pictures that are wanted at once.
#pragma once

#include "petzval/image.h"

namespace petzval::view {

// Every by-th pixel of every by-th row, from the first.
template <typename T>
Image<T> thinned(View<const T> from, int by) {
    Image<T> few((from.width() + by - 1) / by, (from.height() + by - 1) / by);
    for (int y = 0; y < few.height(); ++y)
        for (int x = 0; x < few.width(); ++x) few(x, y) = from(x * by, y * by);
    return few;
}

// Squares of one value. Requires: `few` is of a picture of that size, thinned.
template <typename T>
Image<T> enlarged(View<const T> few, int by, int width, int height) {
    Image<T> all = Image<T>::uninitialised(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) all(x, y) = few(x / by, y / by);
    return all;
}

}  // namespace petzval::view
