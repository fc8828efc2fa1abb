// Very many lights: which kernels they take, what is seen of each, and which parts of the picture they reach.
#pragma once

#include "engine/lights/plan.h"
#include "engine/lights/sprite_kernels.h"
#include "engine/waist/engine.h"

#include <span>

namespace petzval::engine {

// The lights of a picture, by the kernels of `grid`, which was made for them. What is wholly hidden reaches
// no tile. The same for any thread count.
LightsPlan plan_sprites(const EngineView& input, std::span<const Sprite> sprites, const SpriteGrid& grid);

}  // namespace petzval::engine
