// Arrays on their way to the page. Their layout stands where they are written, and in web/lab/gather-pass.js.
#pragma once

#include "base/bits.h"

#include <cstdint>
#include <vector>

// Defined by the page (web/kernel/hand-over.js): copies `count` words under this name.
extern "C" void petzval_hand_over(const char* name, const std::uint32_t* words, std::uint32_t count);

namespace petzval::device::webgl {

class Words {
public:
    void add(std::uint32_t word) { words_.push_back(word); }
    void add(int number) { words_.push_back(std::uint32_t(number)); }
    void add(float number) { words_.push_back(bits_as<std::uint32_t>(number)); }
    template <typename... More>
    void add_all(More... more) {
        (add(more), ...);
    }
    std::uint32_t count() const { return std::uint32_t(words_.size()); }
    void hand_over(const char* name) const { petzval_hand_over(name, words_.data(), count()); }

private:
    std::vector<std::uint32_t> words_;
};

}  // namespace petzval::device::webgl
