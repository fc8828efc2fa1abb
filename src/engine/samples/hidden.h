// Estimates two things that a picture with depth does not state: the share of each surface in a silhouette's
// pixel, and the surfaces behind a near edge, where a lens looks past it.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/completion_model.h"
#include "engine/samples/connectivity.h"
#include "engine/samples/dim.h"
#include "engine/samples/silhouettes/two_surfaces.h"
#include "engine/samples/sparse_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace petzval::engine {

// A picture, and its surfaces without the light of lamps.
struct LitPicture {
    View<const Rgba> colour;
    Dim dim_of;  // light of the picture without lamps; empty if it has none
    Rgba dim(int x, int y) const { return dim_of ? dim_of(x, y, colour(x, y)) : colour(x, y); }
};

// A separated pixel of a silhouette. The renderer filtered its colour over the pixel and beyond, but its
// depth is that of one point:
//     colour = near_colour + (1 - near_share) far_colour + far_light.
struct Mixture {
    bool shows_far = false;    // true if the depth is that of the farther surface
    bool lights_near = false;  // true if lamps light the nearer surface
    bool lit = false;          // true if lamps light the pixel or one beside it
    bool thin = false;     // true if the nearer surface has no clean pixel nearby, and the pixel is not lit
    float near_share = 0;  // 0…1: coverage of the nearer surface
    Rgba near_colour;      // premultiplied by near_share; includes the light of lamps on this surface
    Rgba far_colour;       // colour of the farther surface if it filled the pixel; without lamps
    Rgba far_light;        // light of lamps behind the nearer surface, as visible in the pixel; a is 0
    float near_coc_px = 0, far_coc_px = 0, lamp_coc_px = 0;
    // 0…1: fraction of the pixel's lamp light that comes from lamps behind the nearer surface.
    float lamps_behind = 0;
    // Facts about the nearer surface: its colour where it fills pixels, the variance of that colour (mean
    // of the channels), and the share that the silhouette's shape suggests.
    Rgba near_clean;
    float near_variance = 0, share_by_shape = 0;

    // The shape and the model err so many times more at strands and beside lamps than at a plain edge.
    float errors() const { return thin || lit ? completion_model.strand_errors : 1; }
    // Separates the colour c of a pixel that shows the farther surface, without lamps.
    void take_apart(Rgba c, float near_covers, Rgba behind) {
        near_share = near_covers;
        const float far_share = 1 - near_share, alpha = far_colour.a;
        near_colour = light_only(c - far_share * behind);
        far_colour = behind;
        if (far_share <= 0) return;
        // In a dark pixel neither surface can have more light than the rest.
        far_colour = light_only((c - near_colour) * (1 / far_share));
        far_colour.a = alpha;
    }
};

using Mixtures = SparseRows<Mixture>;

// Extent of the search that separates a silhouette's pixel.
struct UnmixRule {
    // Largest distance of clean colours that are used.
    int clean_within_px = int(completion_model.clean_within_px);
    bool along_outline = true;  // average the share of the shape along the outline
    static UnmixRule draft() { return {2, false}; }
};

// Finds every pixel that touches a silhouette (also diagonally), and separates those that show the farther
// surface. The clean colours of both surfaces come from their nearest pixels that touch no silhouette (for a
// thin thing without such pixels, from its pixels least like the far side). The share is the mean of all
// shares that explain the pixel; the unexplained rest is the farther surface's detail. Pixels that show the
// nearer surface show hardly any of the farther one: it is filled in first, then unmix_nearer() separates
// them. Light of a lamp goes to one side completely: to the side whose pixels nearby show more of it.
Mixtures unmix_silhouettes(const LitPicture& picture, View<const float> coc_px,
                           View<const unsigned char> connected, Workers& workers, const UnmixRule& rule = {});

// A sample behind the visible one that takes up `share` of its pixel; colour is premultiplied by that and by
// its alpha.
struct Hidden {
    Rgba colour;
    float coc_px = 0;
    float share = 1;
};

// Hidden samples of every pixel, nearest first; pixels may share theirs.
struct HiddenLayers {
    static constexpr int kBand = SparseRows<Hidden>::kBand;  // rows in a band
    static constexpr int kMost = 3;                          // most hidden samples of a pixel
    // A pixel's samples, as a range in the samples of its band.
    struct Range {
        std::uint32_t begin : 30, count : 2;
    };
    SparseRows<Range> ranges;
    std::vector<std::vector<Hidden>> bands;
    std::span<const Hidden> at(int x, int y) const {
        const Range* const range = ranges.at(x, y);
        if (!range) return {};
        return {bands[std::size_t(y / kBand)].data() + range->begin, range->count};
    }
    std::span<Hidden> at(int x, int y) {
        const Range* const range = ranges.at(x, y);
        if (!range) return {};
        return {bands[std::size_t(y / kBand)].data() + range->begin, range->count};
    }
};

// Separates silhouette pixels that show the nearer surface, before the hidden surfaces behind them.
void unmix_nearer(Mixtures& mixtures, const LitPicture& picture, const HiddenLayers& hidden,
                  Workers& workers);

// Pixels of a square share the surfaces found for one of them, if these are blurred by shared_from_px or
// more: squares of 2 x 2, of 4 at twice that radius, of 8 at six times. An empty answer is not shared,
// because it depends on the pixel's distance from the silhouette.
struct FillRule {
    float shared_from_px = completion_model.shared_from_px;
    // Directions that are searched first, of 16, 8 or 4, and all that are searched if no surface was met
    // there.
    int first_directions = 8, directions = 16;
    bool textures = true;  // continue the texture of surfaces in focus
    // Edges of the picture continue straight on surfaces whose blur radius is at most this.
    float edges_to_px = std::numeric_limits<float>::infinity();
    // Only surfaces at smaller signed radii are looked behind.
    float hides_before_px = std::numeric_limits<float>::infinity();
    bool smooths = true;  // neighbours agree on colours (behind/smooth.h)
    static FillRule draft() { return {1.5f, 4, 8, false, 6}; }
    // For previews, whose rings of kernels hide grain and small errors.
    static FillRule preview() {
        return {.shared_from_px = 1.5f,
                .first_directions = 4,
                .directions = 4,
                .textures = false,
                .edges_to_px = -1,
                .hides_before_px = -1,
                .smooths = false};
    }
};

// Continues what lies behind every surface inwards from its silhouettes, as far as any lens ray can reach
// behind it. Only from surfaces farther than the one that hides. Along opposite directions that agree,
// colours are interpolated (edges run on behind a thin thing); otherwise the nearest continues. The weights
// fall with distance a little faster than those of the mean-value interpolant (M. Floater, "Mean value
// coordinates", 2003), 1/distance: its power of 1.5 comes closer on the path-traced fence.
HiddenLayers fill_hidden(const LitPicture& picture, View<const float> coc_px,
                         View<const unsigned char> connected, const Mixtures& mixtures, float nearest_coc_px,
                         float farthest_coc_px, const FillRule& rule, Workers& workers);

}  // namespace petzval::engine
