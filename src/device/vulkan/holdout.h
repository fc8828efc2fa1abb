// A holdout as the device's programs read it.
#pragma once

#include "engine/waist/engine.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace petzval::device::vulkan {

// For rows y0…y1-1, `width` pixels each: where each pixel's samples begin, and the end; from `samples` on the
// radius and coverage of each.
struct HoldoutWords {
    std::vector<std::uint32_t> words{0};
    std::uint32_t row = 0, width = 0, samples = 0;

    HoldoutWords() = default;
    HoldoutWords(engine::CocSamplesView holdout, int y0, int y1, int pixels) {
        if (holdout.empty()) return;
        words.clear();
        std::vector<std::uint32_t> values;
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < pixels; ++x) {
                words.push_back(std::uint32_t(values.size() / 2));
                for (const engine::CocSample& s : holdout.at(x, y))
                    values.insert(values.end(), {std::bit_cast<std::uint32_t>(s.coc_px),
                                                 std::bit_cast<std::uint32_t>(s.colour.a)});
            }
        words.push_back(std::uint32_t(values.size() / 2));
        row = std::uint32_t(y0), width = std::uint32_t(pixels), samples = std::uint32_t(words.size());
        words.insert(words.end(), values.begin(), values.end());
    }
};

}  // namespace petzval::device::vulkan
