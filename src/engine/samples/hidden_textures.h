// Textures of surfaces in focus: behind what hides them they go on as textures.
//
// Around each silhouette it is found what repeats (repeats.h): what lies behind the silhouette is then what
// shows an offset away, as far as the surroundings look like theirs. Grain, of which no place tells of
// another, goes on as any other piece of it.
#pragma once

#include "engine/samples/known_surfaces.h"
#include "engine/samples/repeats.h"

#include <array>
#include <vector>

namespace petzval::engine {

class HiddenTextures {
public:
    // Borrows both. reach_px: how far behind a silhouette a lens looks; 0: nothing goes on.
    HiddenTextures(const KnownSurfaces& known, const Mixtures& mixtures, float reach_px, Workers& workers);

    // What is hidden there, of the surface that shows at `shown`: its texture there as far as one can
    // tell, else `otherwise`.
    Rgba going_on(KnownSurfaces::Place shown, CutEdges::Point hidden, Rgba otherwise) const;

private:
    static constexpr int kTile = 32;      // pixels on a side; silhouettes in it share a texture
    static constexpr int kBlock = 8;      // pixels on a side that have one mean
    static constexpr float kSharpPx = 3;  // radius; what is blurred more shows no texture

    // The sum of the sharp pixels of a block, or of some blocks.
    struct Sum {
        Rgba light;
        float count = 0;
        void add(const Sum& other, float weight) {
            light += weight * other.light, count += weight * other.count;
        }
    };
    struct Tile {
        int x, y;  // its first pixel
        Texture texture;
    };

    void measure_means(Workers& workers);
    void measure_details(Workers& workers);
    Texture texture_around(const Tile& tile) const;
    float detail(int x, int y) const;
    bool in_sight(const Rect& block) const;
    bool sharp(int x, int y) const { return std::abs(known_.radii()(x, y)) < kSharpPx; }
    bool shows(int x, int y, float coc_px) const {
        return known_.radii().rect().contains(x, y) && sharp(x, y) &&
               one_surface(known_.radii()(x, y), coc_px);
    }
    Rgba mean(float x, float y) const;
    Rgba mean(int x, int y) const { return mean(float(x), float(y)); }
    Rgba with_grain(KnownSurfaces::Place shown, CutEdges::Point hidden, float grain, Rgba otherwise) const;

    const KnownSurfaces& known_;
    int farthest_, around_;  // offset; what is held against others around a tile: pixels of details
    Image<int> tile_at_;     // of tiles_; -1: none
    std::vector<Tile> tiles_;
    Image<Sum> means_;  // of 3x3 blocks, of what tiles look at
    static constexpr float kUnknown = -2;
    Plane details_;  // as of Details; only while tiles are measured
};

}  // namespace petzval::engine
