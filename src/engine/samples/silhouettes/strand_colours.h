// The colours of strands narrower than a pixel, each found along its length.
#pragma once

#include "engine/samples/hidden.h"

#include <vector>

namespace petzval::engine {

// Radius between a strand and the surface behind it, px.
inline float strand_threshold_px(const Mixture& m) { return 0.5f * (m.near_coc_px + m.far_coc_px); }

class StrandColours {
public:
    // Borrows all but the last.
    StrandColours(const Mixtures& mixtures, const LitPicture& picture, View<const float> coc_px,
                  Workers& workers);

    // The strand's colour, from the statements around the pixel; where there are none, that of its pixels
    // least like the far side.
    Rgba at(int x, int y, const Mixture& m) const;

private:
    // The colour of one strand by its pixels in a block: the least squares of share * colour = light.
    struct Statement {
        float coc_px = 0, share2 = 0;  // share2: sum of squared shares
        float x = 0, y = 0;            // of the pixels, weighted by them
        Rgba light;                    // sum of share * light
    };

    void state(int x, int y, const Mixture& m);
    Statement& statement(int bx, int by, float coc_px);

    const Mixtures& mixtures_;
    const LitPicture& picture_;
    View<const float> coc_;
    int width_, height_;  // in blocks
    std::vector<std::vector<Statement>> blocks_;
};

}  // namespace petzval::engine
