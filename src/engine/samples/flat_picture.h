// All samples of a flat picture: its silhouettes are separated, and hidden surfaces estimated.
#pragma once

#include "engine/samples/complete.h"
#include "engine/samples/kept_surfaces.h"

#include <memory>

namespace petzval::engine {

// Borrows all for the life of the result.
std::unique_ptr<CompletedPicture::Parts> flat_picture(const EngineView& input,
                                                      View<const unsigned char> connected, const Dim& dim);
// The surfaces in front of a plate, and behind them `back`, the completed plate, whose picture shows the
// radii back_px. Borrows all but `before`.
std::unique_ptr<CompletedPicture::Parts> picture_before_plate(const EngineView& input, FoundSurfaces before,
                                                              const CocSamples& back,
                                                              View<const float> back_px);
// Resizes samples that will be overwritten; keeps their memory.
void restart(CocSamples& samples, int width, int height, std::size_t count);

}  // namespace petzval::engine
