// From one picture with depth to all that a lens may see of the scene: silhouettes taken apart, hidden parts
// continued.
#pragma once

#include "petzval/workers.h"

#include "engine/samples/dim.h"
#include "engine/waist/engine.h"

#include <memory>

namespace petzval::engine {

// Every sample of every pixel, nearest first, put together by rows. A deep input says it all itself; of a
// flat one, pixels at silhouettes are taken apart into what they show of each surface, and what is hidden
// near silhouettes is filled in (engine/samples/hidden.h). What a flat pixel leaves uncovered (alpha below 1)
// lies at the far end as emptiness: covered, transparent black. `connected`:
// connections(input.samples.coc_px). Of a picture before a clean plate, that is completed, and what is in
// front of it put before.
class CompletedPicture {
public:
    // `input` outlives this.
    CompletedPicture(const EngineView& input, View<const unsigned char> connected, const Dim& dim);
    // Rows y0…y1-1; from any thread. In place of what was in `into`, with its memory.
    void rows(int y0, int y1, CocSamples& into) const { parts_->rows(y0, y1, into); }
    CocSamples all() const {
        CocSamples samples;
        rows(0, height_, samples);
        return samples;
    }
    std::size_t sample_count() const { return parts_->sample_count; }
    float largest_coc_px() const { return parts_->largest_coc_px; }  // of any |radius|

    // What it is made of.
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

// From samples that dim each other (Samples::deep_dims_itself) to shares of the lens: what a ray straight
// through the pixel meets stays what it was. Translucent samples are dimmed by the translucent ones in front
// of them. An opaque one takes what is left of the lens anyway, and rays that come past what is in front of
// it see all of it; only translucent samples composited with it in one layer (engine/scatter/sources.h) dim
// it, and it hides what else is in that layer. For what is left once highlights are taken: they look for what
// is in front of them themselves. another_surface: of LensLeft.
void share_lens_area(CocSamples& samples, int another_surface, Workers& workers);

}  // namespace petzval::engine
