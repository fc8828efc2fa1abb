// Values that few pixels have, found row by row.
#pragma once

#include "petzval/image.h"

#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace petzval::engine {

template <typename T>
class SparseRows {
public:
    SparseRows() = default;  // no pixel has one
    // Rows in parallel: find(y, emit) calls emit(x, value) of the pixels of row y that have one.
    template <typename Find>
    SparseRows(int width, int height, Workers& workers, const Find& find)
        : index_(Image<int>::uninitialised(width, height)), rows_(std::size_t(height)) {
        parallel_for(height, workers, [&](int y) {
            std::vector<T>& row = rows_[std::size_t(y)];
            int* const index = index_.row(y);
            std::fill_n(index, width, -1);
            find(y, [&](int x, const T& value) {
                index[x] = int(row.size());
                row.push_back(value);
            });
        });
        if (std::all_of(rows_.begin(), rows_.end(), [](const auto& row) { return row.empty(); }))
            index_ = {}, rows_ = {};
    }

    bool empty() const { return rows_.empty(); }
    const T* at(int x, int y) const {
        if (empty()) return nullptr;
        const int i = index_(x, y);
        return i < 0 ? nullptr : &rows_[std::size_t(y)][std::size_t(i)];
    }

private:
    Image<int> index_;  // into the values of its row, or -1
    std::vector<std::vector<T>> rows_;
};

}  // namespace petzval::engine
