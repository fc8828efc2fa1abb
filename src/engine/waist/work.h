// What a stage has done, counted by the code that does it from the sizes of what it reads and writes; what is
// counted is said in docs/command-line.md ("The report").
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace petzval::engine {

struct Work {
    std::uint64_t bytes = 0, multiply_adds = 0;

    Work& operator+=(Work other) {
        bytes += other.bytes, multiply_adds += other.multiply_adds;
        return *this;
    }
    // Kernels of `taps` pixels in all, added to sums: RGBA weights and sums read, sums written.
    static Work of_taps(std::size_t taps) { return {48 * taps, 4 * taps}; }
};

// Counted from many threads.
class WorkCount {
public:
    void add(Work work) { bytes_ += work.bytes, multiply_adds_ += work.multiply_adds; }
    Work sum() const { return {bytes_, multiply_adds_}; }

private:
    std::atomic<std::uint64_t> bytes_ = 0, multiply_adds_ = 0;
};

}  // namespace petzval::engine
