// All samples of a flat picture: its silhouettes are separated, and hidden surfaces estimated.
#pragma once

#include "engine/samples/complete.h"
#include "engine/samples/kept_surfaces.h"

#include <memory>

namespace petzval::engine {

// Borrows all for the life of the result.
std::unique_ptr<CompletedPicture::Parts> flat_picture(const EngineView& input,
                                                      View<const unsigned char> connected, const Dim& dim);
// Resizes samples that will be overwritten; keeps their memory.
void restart(CocSamples& samples, int width, int height, std::size_t count);

}  // namespace petzval::engine
