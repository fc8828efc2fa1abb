// Words the host writes for device programs and reads back: shared by all that list tiles and lights.
#pragma once

#include "petzval/image.h"

#include "engine/lights/plan.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace petzval::device::vulkan {

inline std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }

// Adds a rectangle and the index where its list begins; the next rectangle's index ends the list.
inline void add_rect(std::vector<std::uint32_t>& words, const Rect& r, std::size_t first) {
    words.insert(words.end(), {std::uint32_t(r.x0), std::uint32_t(r.y0), std::uint32_t(r.x1),
                               std::uint32_t(r.y1), std::uint32_t(first)});
}

// A light as shaders/add_lights.comp reads it; the last two name its viewpoint or its mask.
constexpr std::size_t kLightWords = 10;
inline void add_light(std::vector<std::uint32_t>& words, const engine::PlannedLight& light, Rgba colour,
                      float coc_px, std::uint32_t seen, std::uint32_t more) {
    const engine::Highlight& h = light.highlight;
    words.insert(words.end(),
                 {std::uint32_t(h.x), std::uint32_t(h.y), bits_of(colour.r), bits_of(colour.g),
                  bits_of(colour.b), bits_of(colour.a), bits_of(coc_px), light.kernel, seen, more});
}

}  // namespace petzval::device::vulkan
