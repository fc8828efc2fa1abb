// Textures of surfaces in focus continue behind their occluders as textures.
//
// Around each silhouette, repetitions of the picture are found (repeats.h), and of these the ones that hold
// around each block of pixels. The hidden part is then the visible part an offset away, as far as their
// surroundings are alike. Grain, where no place predicts another, continues as any other piece of itself.
#pragma once

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/textures/repeats.h"
#include "engine/samples/textures/sharp_means.h"

#include <array>
#include <vector>

namespace petzval::engine {

class HiddenTextures {
    // Pieces of a surface's texture that are moved to a hidden point, less the means around where they show.
    struct Moved {
        int block = -1;
        float coc_px = 0;
        float grain = 0, alike = 0;  // 0: none
        Rgba grain_detail, detail;
        int dx = 0, dy = 0;
    };

public:
    // Borrows both. reach_px: how far behind a silhouette a lens looks; 0: no texture continues.
    HiddenTextures(const KnownSurfaces& known, const Mixtures& mixtures, float reach_px, Workers& workers);

    // A hidden point. Keeps the textures found there: most surfaces met around it belong to one tile.
    class Point {
    public:
        Point(const HiddenTextures& textures, int x, int y) : textures_(textures), x_(x), y_(y) {}
        // The hidden texture of the surface visible at `shown`. Its colour is premultiplied by its share,
        // 0…1. The rest is not textured.
        struct Told {
            Rgba colour;
            float share = 0;
        };
        Told going_on(KnownSurfaces::Place shown);

    private:
        const Moved& moved_to_here(int block, float coc_px);

        const HiddenTextures& textures_;
        int x_, y_;
        std::array<Moved, 4> found_;  // one entry for all blocks with the same last digits
    };

private:
    static constexpr int kTile = 32;  // side of a tile in pixels; its silhouettes share a texture
    static constexpr int kBlock = SharpMeans::kBlock;
    static constexpr int kBlocks = kTile / kBlock;  // on each side of a tile
    static constexpr int kTileBlocks = kBlocks * kBlocks;

    struct Tile {
        int x, y;  // its first pixel
        float grain;
        std::array<std::vector<Texture::Offset>, kTileBlocks> repeats;  // of each block; best first
    };

    void measure_details(Workers& workers);
    Texture texture_around(const Tile& tile) const;
    void find_repeats(Tile& tile) const;
    float alike_around(const Rect& block, int dx, int dy) const;
    int block_at(int x, int y) const;
    const Tile& tile_of(int block) const { return tiles_[std::size_t(block / kTileBlocks)]; }
    float detail(int x, int y) const;
    bool in_sight(const Rect& block) const;
    bool sharp(int x, int y) const { return shows_sharp(known_, x, y) && !is_lamp(x, y); }
    // Textures do not contain lamps: between strands, a lamp would be most of the contrast, and continue
    // wherever a repeat meets it.
    bool is_lamp(int x, int y) const {
        constexpr float kLamp = 2;  // times the mean light around; a sky among leaves is less
        const float light = luminance(known_.colour(x, y));
        return known_.white() > 0 && light > known_.white() && light > kLamp * luminance(mean(x, y));
    }
    bool shows(int x, int y, float coc_px) const {
        return known_.radii().rect().contains(x, y) &&
               std::abs(known_.radii()(x, y) - coc_px) < completion_model.step_px && sharp(x, y);
    }
    Rgba detail_of_pixel(int x, int y) const { return known_.colour(x, y) - mean(x, y); }
    Rgba mean(float x, float y) const { return means_.at(x, y); }
    Rgba mean(int x, int y) const { return mean(float(x), float(y)); }
    Moved moved_to(int x, int y, int block, float coc_px) const;
    void move_grain(int x, int y, Moved& moved) const;

    const KnownSurfaces& known_;
    int farthest_, around_;  // in pixels of details: largest offset; width compared around a tile
    Image<int> tile_at_;     // number in tiles_; -1: none
    std::vector<Tile> tiles_;
    SharpMeans means_;  // of the blocks that tiles read
    static constexpr float kUnknown = -2;
    Plane details_;  // as of Details; only while tiles are measured
};

}  // namespace petzval::engine
