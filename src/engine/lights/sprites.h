// Lights drawn one by one with the lens's own kernels: very many, of few kernels, shadowed by 8 x 8 rays
// each.
#pragma once

#include "device/device.h"
#include "engine/lights/sprite_kernels.h"
#include "engine/waist/engine.h"

#include <cstddef>
#include <span>

namespace petzval::engine {

// Adds the lights found in the picture and the given ones, each in the light of its lamp. `input`: everything
// that may occlude them.
device::Work draw_sprites(const EngineView& input, std::span<const Sprite> found, device::Target out);

// Memory that drawing them takes besides the picture and the result.
std::size_t sprites_bytes(const EngineView& input, std::size_t found);

}  // namespace petzval::engine
