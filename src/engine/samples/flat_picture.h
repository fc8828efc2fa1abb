// All samples of a flat picture: its silhouettes are separated, and hidden surfaces estimated.
#pragma once

#include "engine/samples/complete.h"

#include <memory>

namespace petzval::engine {

// Borrows all for the life of the result. back: the completed clean plate, placed behind the surfaces in
// front of it; null: there is none.
std::unique_ptr<CompletedPicture::Parts> flat_picture(const EngineView& input,
                                                      View<const unsigned char> connected, const Dim& dim,
                                                      const CocSamples* back = nullptr);
// Resizes samples that will be overwritten; keeps their memory.
void restart(CocSamples& samples, int width, int height, std::size_t count);

}  // namespace petzval::engine
