// Many lights added to a picture, each as its kernel, dimmed where something nearer hides it.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// One light. Unlike a given point it has no depth and no size any more.
struct Sprite {
    float x = 0, y = 0;  // pixels, centres at +0.5
    float coc_px = 0;
    float r = 0, g = 0, b = 0;
};

// Adds them to `out`, the size of the input's picture. The same bits for any thread count.
void draw_sprites(const Input& input, std::span<const Sprite> sprites, View<Rgba> out);

}  // namespace petzval::engine
