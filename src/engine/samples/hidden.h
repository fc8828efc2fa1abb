// Estimates two things that a picture with depth does not state: the coverage of each surface in a pixel of a
// silhouette, and the surfaces behind a near edge, which rays through the rim of the lens reach.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/completion_model.h"
#include "engine/samples/dim.h"
#include "engine/samples/silhouettes/connectivity.h"
#include "engine/samples/silhouettes/two_surfaces.h"
#include "engine/samples/sparse_rows.h"
#include "engine/samples/white.h"
#include "engine/waist/view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace petzval::engine {

// A picture, with and without the light of lamps.
struct LitPicture {
    View<const Rgba> colour;
    Dim dim_of;  // the picture without lamps; empty if it has no lamps
    // Parts of hidden surfaces that are known (a plate that does not cover the frame); empty: none.
    CleanPlate patches = {};
    Rgba dim(int x, int y) const { return dim(x, y, colour(x, y)); }
    Rgba dim(int x, int y, Rgba light) const { return dim_of ? dim_of(x, y, light) : light; }
    bool is_patch(int x, int y) const { return !patches.empty() && patches.is_stated(x, y); }
    // Luminance that counts as black; keeps reciprocals finite.
    float black() const { return black_of(dim_of.white); }
};

// A pixel of a silhouette, separated into two surfaces. The renderer filtered the pixel's colour over its
// area and beyond, but its depth is that of one point:
//     colour = near_colour + (1 - near_share) far_colour + far_light.
struct Mixture {
    bool shows_far : 1 = false;    // true if the depth is that of the farther surface
    bool lights_near : 1 = false;  // true if lamps light the nearer surface
    bool lit : 1 = false;          // true if lamps light the pixel or one beside it
    // True if no clean pixel of the nearer surface is nearby, and the pixel is not lit.
    bool thin : 1 = false;
    // True if the pixel shows the farther surface, no clean pixel of which is nearby, and it is not lit.
    bool enclosed : 1 = false;
    float near_share = 0;  // 0…1: coverage of the nearer surface
    Rgba near_colour;      // premultiplied by near_share; includes the light of lamps on this surface
    Rgba far_colour;       // colour of the farther surface if it filled the pixel; without lamps
    Rgba far_light;        // visible light of lamps behind the nearer surface; a is 0
    float near_coc_px = 0, far_coc_px = 0, lamp_coc_px = 0;
    // 0…1: fraction of the pixel's lamp light that comes from lamps behind the nearer surface.
    float lamps_behind = 0;
    // The nearer surface's colour where it fills pixels, and the most light of the farther one there. Then
    // the variances of both colours (mean of the channels), and the coverage that the silhouette's shape
    // suggests.
    Rgba near_clean, far_most;
    float near_variance = 0, far_variance = 0, share_by_shape = 0;

    // Errors of shape and model; larger at strands and beside lamps.
    ModelErrors errors(const LitPicture& picture) const {
        return {thin || enclosed || lit ? completion_model.strand_errors : 1, picture.dim_of.white};
    }
    // Separates the colour c, without lamps, of a pixel that shows the farther surface.
    void take_apart(Rgba c, float near_covers, Rgba behind) {
        near_share = near_covers;
        const float far_share = 1 - near_share, alpha = far_colour.a;
        near_colour = light_only(c - far_share * behind);
        far_colour = behind;
        if (far_share <= 0) return;
        // In a dark pixel the farther surface has no more light than the nearer one leaves.
        far_colour = light_only((c - near_colour) * (1 / far_share));
        far_colour.a = alpha;
    }
};

using Mixtures = SparseRows<Mixture>;

// Extent of the search that separates a silhouette's pixel.
struct UnmixRule {
    // Clean colours are searched up to this distance.
    int clean_within_px = int(completion_model.clean_within_px);
    bool along_outline = true;  // true: average the coverage from the shape along the outline
    static UnmixRule draft() { return {2, false}; }
};

// Finds every pixel that touches a silhouette (also diagonally), and separates those that show the farther
// surface. The clean colours of both surfaces come from their nearest pixels that touch no silhouette. If a
// thin object has none, its colour comes from its pixels that differ most from the far side. The
// coverage is the mean of all values that explain the pixel; the unexplained rest is the farther surface's
// detail. Pixels that show the nearer surface show little of the farther one, so fill_hidden() estimates the
// farther surface before unmix_nearer() separates them. Light of a lamp belongs to one side completely: the
// side whose pixels nearby show more of it.
Mixtures unmix_silhouettes(const LitPicture& picture, View<const float> coc_px,
                           View<const unsigned char> connected, Workers& workers, const UnmixRule& rule = {});

// A sample behind the visible one. It covers `share` of its pixel; its colour is premultiplied by share and
// alpha.
struct Hidden {
    Rgba colour;
    float coc_px = 0;
    float share = 1;
};

// Hidden samples of every pixel, nearest first. Several pixels may share one list of samples.
struct HiddenLayers {
    static constexpr int kBand = SparseRows<Hidden>::kBand;  // rows in a band
    static constexpr int kMost = 3;                          // a pixel has at most so many hidden samples
    // A pixel's samples are a range of its band's samples.
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
    // The samples of this pixel alone: copies, if others share them. Not for two pixels of a band at a time.
    std::span<Hidden> own(int x, int y) {
        Range& range = *ranges.at(x, y);
        std::vector<Hidden>& band = bands[std::size_t(y / kBand)];
        const std::size_t from = range.begin, to = band.size();
        range.begin = to & ((1U << 30) - 1);
        band.resize(to + range.count);
        std::copy_n(band.begin() + std::ptrdiff_t(from), range.count, band.begin() + std::ptrdiff_t(to));
        return at(x, y);
    }
    std::span<Hidden> at(int x, int y) {
        const Range* const range = ranges.at(x, y);
        if (!range) return {};
        return {bands[std::size_t(y / kBand)].data() + range->begin, range->count};
    }
};

// Separates silhouette pixels that show the nearer surface from the hidden surfaces behind them. Light that
// neither colour explains belongs to the surface whose colour varies more; `hidden` gets its part of that.
void unmix_nearer(Mixtures& mixtures, const LitPicture& picture, HiddenLayers& hidden, Workers& workers);

// Extent of the search for hidden surfaces. Pixels of a square share the surfaces found for one of them if
// the blur radius of these surfaces is at least shared_from_px. The square is 2 x 2 pixels, 4 x 4 at twice
// that radius and 8 x 8 at six times. An empty result is not shared, because it depends on the pixel's
// distance from the silhouette.
struct FillRule {
    float shared_from_px = completion_model.shared_from_px;
    // Number of directions that are searched first, and of those searched if the first find no surface:
    // 16, 8 or 4.
    int first_directions = 8, directions = 16;
    bool textures = true;  // true: continue the texture of surfaces in focus
    // Edges of the picture continue straight on surfaces whose blur radius is at most this.
    float edges_to_px = std::numeric_limits<float>::infinity();
    // Hidden surfaces are estimated only behind occluders with a smaller signed radius.
    float hides_before_px = std::numeric_limits<float>::infinity();
    bool smooths = true;  // true: smooth colours between neighbours (behind/smooth.h)
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

// Continues surfaces behind each occluder, from its silhouettes inwards, as far as any ray of the lens
// reaches behind it. A surface continues only if it is farther than the occluder. If the surfaces in opposite
// directions agree, their colours are interpolated, so edges continue behind thin objects; otherwise the
// nearest surface continues. Witnesses count more along the structure of their surface than across it
// (behind/structure.h). Weights are distance^-1.5. They fall faster than those of the mean-value
// interpolant, 1/distance (M. Floater, "Mean value coordinates", 2003), and come closer to the truth on the
// path-traced fence.
HiddenLayers fill_hidden(const LitPicture& picture, View<const float> coc_px,
                         View<const unsigned char> connected, const Mixtures& mixtures, float nearest_coc_px,
                         float farthest_coc_px, const FillRule& rule, Workers& workers);

}  // namespace petzval::engine
