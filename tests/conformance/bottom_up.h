// Half of all hosts hold the bottom row first: a view with a negative stride is as good as any.
#pragma once

#include "petzval/image.h"

#include <algorithm>

namespace petzval::conformance {

// The rows of an image from the last to the first, and a view that turns them round again.
template <typename T>
class BottomUp {
public:
    explicit BottomUp(const Image<T>& image) : rows_(image.width(), image.height()) {
        for (int y = 0; y < image.height(); ++y)
            std::copy_n(image.row(y), image.width(), rows_.row(image.height() - 1 - y));
    }
    View<const T> view() const {
        return {rows_.row(rows_.height() - 1), rows_.width(), rows_.height(), -rows_.width()};
    }

private:
    Image<T> rows_;
};

}  // namespace petzval::conformance
