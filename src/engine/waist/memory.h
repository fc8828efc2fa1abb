// Memory limits of an engine: job.max_memory_bytes against its known needs.
#pragma once

#include "engine/waist/engine.h"

#include <string>

namespace petzval::engine {

constexpr std::size_t kFixedBytes = std::size_t(19) << 20;  // code, tables, kernels

// Bytes besides the engine's own: the caller's colour and depth, the radii; what is fixed.
inline std::size_t held_bytes(const EngineView& input) {
    const std::size_t pixels = std::size_t(input.width()) * std::size_t(input.height());
    return pixels * (sizeof(Rgba) + 2 * sizeof(float)) + input.samples.deep.samples().size_bytes() +
           kFixedBytes + input.services.beside_bytes;
}

inline Error too_little_memory(const std::string& what, std::size_t needed_bytes) {
    return {ErrorCode::OutOfMemory, "job.max_memory_bytes is too little: " + what + " takes about " +
                                        std::to_string((needed_bytes >> 20) + 1) +
                                        "M for this picture and blur"};
}

inline std::size_t whole_picture_bytes(const EngineView& input, std::size_t bytes_per_pixel) {
    return held_bytes(input) + bytes_per_pixel * std::size_t(input.width()) * std::size_t(input.height());
}

// For engines that work on the whole picture at once. bytes_per_pixel: of their working memory, the result
// included; more_bytes: what does not go with pixels. Errors: OutOfMemory.
inline Status fits_memory(const EngineView& input, std::size_t bytes_per_pixel, const std::string& what,
                          std::size_t more_bytes = 0) {
    const std::size_t needed = whole_picture_bytes(input, bytes_per_pixel) + more_bytes;
    if (input.services.max_memory_bytes == 0 || needed <= input.services.max_memory_bytes) return Done{};
    return too_little_memory(what, needed);
}

}  // namespace petzval::engine
