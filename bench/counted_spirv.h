// A program of the device with a counter in each of its blocks, and the cost of a run of each block.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace petzval::bench {

// Work of one invocation that runs a block once. Operations are 32-bit ones of one lane: a product and the
// sum after it are one, a division, root or power counts 4 (their units have a quarter of the rate).
struct BlockWork {
    double operations = 0, samples = 0, reads = 0, shared = 0;  // reads: of buffers; shared: of shared memory
};

struct CountedSpirv {
    std::vector<std::uint32_t> words;  // counters: 32 bits each, in binding 0 of set 1
    std::vector<BlockWork> blocks;
};

// first: the counter of the program's first block. Requires: a program made by glslc -O.
CountedSpirv counted(std::span<const std::uint32_t> words, std::uint32_t first);

}  // namespace petzval::bench
