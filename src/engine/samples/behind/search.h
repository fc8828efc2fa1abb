// Walks from hidden pixels to the visible surfaces around them.
#pragma once

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/behind/near_silhouettes.h"
#include "engine/samples/hidden.h"
#include "engine/samples/silhouettes/connectivity.h"

#include <array>
#include <vector>

namespace petzval::engine {

constexpr int kDirections = 16;  // an even number, because opposite directions form pairs

// The end of a search: a pixel of the surface that was met.
constexpr int kHits = 2;  // hits kept in each direction
struct Found {
    bool found = false;
    int x = 0, y = 0;
    float coc_px = 0, distance_px = 0;
    Slope slope{};            // of its surface
    bool on_surface = false;  // true if it belongs to the surface in question (behind/one_surface.h)
    KnownSurfaces::Place place() const { return {x, y, coc_px}; }
};
using Hits = std::array<std::array<Found, kHits>, kDirections>;

class SurfaceSearch {
public:
    // Borrows all but the last. nearest_px, farthest_px: radii of the frame.
    SurfaceSearch(const KnownSurfaces& known, View<const float> coc_px, View<const unsigned char> connected,
                  const Mixtures& mixtures, float nearest_px, float farthest_px, Workers& workers);

    // Largest distance from a pixel at which a ray past its surface reaches the surface behind it: a point of
    // the lens moves the two against each other by the difference of their radii.
    static float reach_px(float own_px, float behind_px);

    // A pixel whose hidden surfaces are looked for, at least up to at_least_px away.
    struct Start {
        int x, y;
        float own_px;
        Slope slope;
        float at_least_px;
    };
    // The first clean pixel of a farther surface in the direction k, and of one farther still. Both may lie
    // beyond the reach of the blur: a ray that passes another edge of the occluder reaches the surface there.
    std::array<Found, kHits> look(const Start& from, std::size_t k) const;
    Direction direction(std::size_t k) const { return paths_[k].direction; }

private:
    // Side of a block in pixels; its pixels share one distance to the nearest silhouette.
    static constexpr int kBlock = 4;
    struct Step {
        float t;  // distance of the step, px
        int x, y;
        std::ptrdiff_t offset;  // offset of the pixel in the plane of clean radii
    };
    struct Path {
        Direction direction;
        std::vector<Step> steps;
        std::vector<std::array<int, 2>> pixels;  // x and y at each whole distance
        std::vector<std::size_t> at_distance;    // first step that is at least this many pixels away
    };
    struct Block {
        float farthest = -1e30f;  // farthest known radius in the block
        int free = 1 << 20;       // from any pixel of the block, this many pixels hold no silhouette
    };
    void measure_blocks(const Mixtures& mixtures, Workers& workers);
    void lay_paths(float longest_px);
    bool crosses_silhouette(const Path& path, int x, int y, float t) const;

    const KnownSurfaces& known_;
    View<const float> coc_;
    View<const unsigned char> connected_;
    Image<Block> blocks_;
    std::array<Path, kDirections> paths_;
    float farthest_;
};

}  // namespace petzval::engine
