// Completes one picture with depth to all surfaces that a lens may see: separates silhouettes, continues
// hidden parts.
#pragma once

#include "engine/samples/dim.h"
#include "engine/waist/engine.h"

#include <memory>

namespace petzval::engine {

// Every sample of every pixel, nearest first, by rows. In a flat input, silhouette pixels are separated into
// their surfaces, and hidden parts near silhouettes are estimated (engine/samples/hidden.h). A deep input
// states its samples; surfaces behind opaque ones are estimated (deep/deep_completed.h). In a flat
// pixel with an alpha below 1, emptiness follows right behind the surface; behind a pane, it has the radius
// of the surface beyond the pane (flat_surfaces.h). `connected`: connections(input.samples.coc_px). With a
// clean plate, the plate is completed, and the surfaces in front of it are placed before it.
class CompletedPicture {
public:
    // `input` must outlive this object.
    CompletedPicture(const EngineView& input, View<const unsigned char> connected, const Dim& dim);
    // Writes rows y0…y1-1; from any thread. Replaces the contents of `into` and keeps its memory.
    void rows(int y0, int y1, CocSamples& into) const { parts_->rows(y0, y1, into); }
    CocSamples all() const {
        CocSamples samples;
        rows(0, height_, samples);
        return samples;
    }
    std::size_t sample_count() const { return parts_->sample_count; }
    float largest_coc_px() const { return parts_->largest_coc_px; }  // of any |radius|

    // The source of its rows.
    struct Parts {
        std::size_t sample_count = 0;
        float largest_coc_px = 0;
        Parts() = default;
        Parts(const Parts&) = delete;
        virtual ~Parts() = default;
        virtual void rows(int y0, int y1, CocSamples& into) const = 0;
    };

private:
    std::unique_ptr<const Parts> parts_;
    int height_;
};

}  // namespace petzval::engine
