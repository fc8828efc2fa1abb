// Values of a few pixels, found row by row and stored by bands of rows. The memory of a large frame's bands
// returns to the system as soon as it is released.
#pragma once

#include "petzval/image.h"

#include "base/parallel.h"
#include "image/big_vector.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace petzval::engine {

// std::popcount() calls a function on CPUs that need not have the instruction (the sums of H. Warren,
// "Hacker's Delight", 2013, section 5-1).
inline int bits_set(std::uint64_t word) {
    word -= (word >> 1) & 0x5555555555555555;
    word = (word & 0x3333333333333333) + ((word >> 2) & 0x3333333333333333);
    word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f;
    return int((word * 0x0101010101010101) >> 56);
}

template <typename T>
class SparseRows {
public:
    static constexpr int kBand = 8;  // rows
    SparseRows() = default;          // holds no values
    // find_row() adds the values.
    SparseRows(int width, int height)
        : width_(width),
          words_((width + 63) / 64, height),
          bands_(std::size_t((height + kBand - 1) / kBand)) {}
    // Bands in parallel: find(y, emit) as of find_row().
    template <typename Find>
    SparseRows(int width, int height, Workers& workers, const Find& find) : SparseRows(width, height) {
        parallel_for(int(bands_.size()), workers, [&](int band) {
            for (int y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y)
                find_row(y, [&](const auto& emit) { find(y, emit); });
        });
        if (std::all_of(bands_.begin(), bands_.end(), [](const auto& band) { return band.empty(); }))
            words_ = {}, bands_ = {};
    }
    // Calls find(emit), which calls emit(x, value) for the pixels of row y that have a value, from the
    // left. Call it once per row; rows of one band one after the other.
    template <typename Find>
    void find_row(int y, const Find& find) {
        std::vector<T> row;
        Word* const words = words_.row(y);
        find([&](int x, const T& value) {
            words[x / 64].has |= std::uint64_t(1) << (x % 64);
            row.push_back(value);
        });
        BigVector<T>& band = bands_[std::size_t(y / kBand)];
        // Reserved room that is not written costs no memory.
        if (band.empty()) band.reserve(2 * kBand * row.size());
        words[0].before = std::uint32_t(band.size());
        for (int i = 1; i < words_.width(); ++i)
            words[i].before = words[i - 1].before + std::uint32_t(bits_set(words[i - 1].has));
        band.insert(band.end(), row.begin(), row.end());
    }

    bool empty() const { return bands_.empty(); }
    int width() const { return width_; }
    int height() const { return words_.height(); }
    const T* at(int x, int y) const { return find(*this, x, y); }
    T* at(int x, int y) { return find(*this, x, y); }
    // The values of a row from the left, as visit(x, value).
    template <typename Visit>
    void for_each_in_row(int y, const Visit& visit) const {
        visit_row(*this, y, visit);
    }
    template <typename Visit>
    void for_each_in_row(int y, const Visit& visit) {
        visit_row(*this, y, visit);
    }
    std::size_t bytes() const {
        std::size_t values = 0;
        for (const auto& band : bands_) values += band.size();
        return values * sizeof(T) + words_.size() * sizeof(Word);
    }

private:
    template <typename Self>
    static auto find(Self& self, int x, int y) -> decltype(self.bands_[0].data()) {
        if (self.empty()) return nullptr;
        const Word& word = self.words_(x / 64, y);
        const std::uint64_t own = std::uint64_t(1) << (x % 64);
        if ((word.has & own) == 0) return nullptr;
        return self.bands_[std::size_t(y / kBand)].data() + word.before + bits_set(word.has & (own - 1));
    }

    template <typename Self, typename Visit>
    static void visit_row(Self& self, int y, const Visit& visit) {
        if (self.empty()) return;
        auto* value = self.bands_[std::size_t(y / kBand)].data() + self.words_(0, y).before;
        for (int i = 0; i < self.words_.width(); ++i)
            for (std::uint64_t has = self.words_(i, y).has; has != 0; has &= has - 1)
                visit(64 * i + std::countr_zero(has), *value++);
    }

    // 64 pixels of a row: which have a value, and how many of the band have one before them.
    struct Word {
        std::uint64_t has = 0;
        std::uint32_t before = 0;
    };
    int width_ = 0;
    Image<Word> words_;
    std::vector<BigVector<T>> bands_;
};

}  // namespace petzval::engine
