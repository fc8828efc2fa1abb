#include "engine/samples/textures/hidden_textures.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"

#include <algorithm>

namespace petzval::engine {
namespace {

constexpr int kScale = 2;  // side, in pixels, of one pixel of details

}  // namespace

// A tile reads pixels within 4 of its reach and 96 px: less than outlines do (docs/conventions.md).
HiddenTextures::HiddenTextures(const KnownSurfaces& known, const Mixtures& mixtures, float reach_px,
                               Workers& workers)
    : known_(known),
      farthest_(std::min(32, int(reach_px) + 8)),
      around_(std::min(28, 12 + int(reach_px) / 2)) {
    if (reach_px <= 0) return;
    const Rect all = known.radii().rect();
    tile_at_ = Image<int>((all.width() + kTile - 1) / kTile, (all.height() + kTile - 1) / kTile, -1);
    for (int y = 0; y < all.height(); ++y)
        mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
            int& tile = tile_at_(x / kTile, y / kTile);
            // (A sharp occluder hides nothing that is equally sharp from any point of the lens.)
            if (tile >= 0 || m.near_coc_px > -completion_model.texture_sharp_px ||
                std::abs(m.far_coc_px) >= completion_model.texture_sharp_px)
                return;
            tile = int(tiles_.size());
            tiles_.push_back({x / kTile * kTile, y / kTile * kTile, 0, {}});
        });
    if (tiles_.empty()) return;
    means_ = SharpMeans(
        known, [this](const Rect& block) { return in_sight(block); }, workers);
    measure_details(workers);
    parallel_for(int(tiles_.size()), workers, [&](int i) { find_repeats(tiles_[std::size_t(i)]); });
    details_ = {};
}

// True if any tile reads the block.
bool HiddenTextures::in_sight(const Rect& block) const {
    const Rect near = block.grown(kScale * (farthest_ + around_) + 2 * kBlock);
    const int y1 = std::min(near.y1 / kTile, tile_at_.height() - 1);
    const int x1 = std::min(near.x1 / kTile, tile_at_.width() - 1);
    for (int y = std::max(0, near.y0 / kTile); y <= y1; ++y)
        for (int x = std::max(0, near.x0 / kTile); x <= x1; ++x)
            if (tile_at_(x, y) >= 0) return true;
    return false;
}

void HiddenTextures::measure_details(Workers& workers) {
    const Rect all = known_.radii().rect();
    details_ = Plane(all.width() / kScale, all.height() / kScale, kUnknown);
    parallel_for(details_.height(), workers, [&](int v) {
        const int y = v * kScale;
        for (int x = 0; x + 1 < all.width(); x += kScale)
            if (means_.known_at(x, y) && sharp(x, y) && sharp(x + 1, y) && sharp(x, y + 1) &&
                sharp(x + 1, y + 1))
                details_(x / kScale, v) = detail(x, y);
    });
}

// Mean of the sharp pixels among 2 x 2.
float HiddenTextures::detail(int x, int y) const {
    const Rgba sum =
        known_.colour(x, y) + known_.colour(x + 1, y) + known_.colour(x, y + 1) + known_.colour(x + 1, y + 1);
    const float light = std::max(0.0f, 0.25f * luminance(comparable(sum)));
    const float around = std::max(0.0f, luminance(comparable(mean(float(x) + 0.5f, float(y) + 0.5f))));
    return (light - around) / (light + around + 1e-20f);
}

Texture HiddenTextures::texture_around(const Tile& tile) const {
    Details piece(kTile / kScale + 2 * around_, farthest_);
    const int u0 = tile.x / kScale - around_ - farthest_, v0 = tile.y / kScale - around_ - farthest_;
    const Rect inside = Rect{u0, v0, u0 + piece.side, v0 + piece.side}.intersected(details_.rect());
    for (int v = inside.y0; v < inside.y1; ++v)
        for (int u = inside.x0; u < inside.x1; ++u)
            if (details_(u, v) != kUnknown) piece.set(u - u0, v - v0, details_(u, v));
    return texture_of(piece);
}

// Correlation of a repeat within 20 px of a block, -1…1; 1 where hardly anything is known.
float HiddenTextures::alike_around(const Rect& block, int dx, int dy) const {
    constexpr int kAround = 10;  // pixels of details
    constexpr float kLeastPairs = 16;
    const Rect all = details_.rect(), moved{all.x0 - dx, all.y0 - dy, all.x1 - dx, all.y1 - dy};
    const Rect window = block.grown(kAround).intersected(all).intersected(moved);
    Pairs pairs;
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            const float a = details_(u, v), b = details_(u + dx, v + dy);
            if (a == kUnknown || b == kUnknown) continue;
            pairs.products += a * b;
            pairs.squares += a * a + b * b;
            pairs.count += 1;
        }
    return pairs.count < kLeastPairs ? 1 : pairs.alike();
}

// The repeats of a tile are those of its strongest texture. Beside that texture they would move any mark
// behind the occluder, so each block keeps those that hold around itself.
void HiddenTextures::find_repeats(Tile& tile) const {
    constexpr int kSide = kBlock / kScale;
    constexpr float kOff = 0.1f;  // a few pixels of a texture correlate less than all of it by as much
    const Texture texture = texture_around(tile);
    tile.grain = texture.grain;
    for (int i = 0; i < kTileBlocks; ++i) {
        auto& repeats = tile.repeats[std::size_t(i)];
        const int u = tile.x / kScale + i % kBlocks * kSide, v = tile.y / kScale + i / kBlocks * kSide;
        for (Texture::Offset o : texture.repeats) {
            if (o.alike <= completion_model.texture_least) break;
            const int dx = nearest_pixel(o.x), dy = nearest_pixel(o.y);
            o.alike = std::min(o.alike, alike_around({u, v, u + kSide, v + kSide}, dx, dy) + kOff);
            o.x *= kScale, o.y *= kScale;
            if (o.alike > completion_model.texture_least) repeats.push_back(o);
        }
        std::stable_sort(repeats.begin(), repeats.end(),
                         [](const auto& a, const auto& b) { return a.alike > b.alike; });
    }
}

// The number of the pixel's block among those of all tiles; -1: its tile has no silhouette.
int HiddenTextures::block_at(int x, int y) const {
    const int tile = tile_at_(x / kTile, y / kTile);
    return tile < 0 ? -1 : (tile * kBlocks + y % kTile / kBlock) * kBlocks + x % kTile / kBlock;
}

void HiddenTextures::move_grain(int x, int y, Moved& moved) const {
    constexpr std::array<std::array<int, 2>, 8> kWays{
        {{4, 0}, {-4, 0}, {0, 4}, {0, -4}, {3, 3}, {-3, -3}, {3, -3}, {-3, 3}}};
    for (int far = 4; far <= 16; far += 4)
        for (const auto& way : kWays) {
            const int u = x + far * way[0], v = y + far * way[1];
            if (!shows(u, v, moved.coc_px)) continue;
            moved.grain = tile_of(moved.block).grain;
            moved.grain_detail = detail_of_pixel(u, v);
            return;
        }
}

HiddenTextures::Moved HiddenTextures::moved_to(int x, int y, int block, float coc_px) const {
    const Tile& tile = tile_of(block);
    Moved moved;
    moved.block = block, moved.coc_px = coc_px;
    if (tile.grain > 0) move_grain(x, y, moved);
    for (const Texture::Offset& o : tile.repeats[std::size_t(block % kTileBlocks)]) {
        const int dx = nearest_pixel(o.x), dy = nearest_pixel(o.y);
        if (!shows(x + dx, y + dy, coc_px)) continue;
        moved.alike = o.alike, moved.dx = dx, moved.dy = dy;
        moved.detail = detail_of_pixel(x + dx, y + dy);
        break;
    }
    return moved;
}

const HiddenTextures::Moved& HiddenTextures::Point::moved_to_here(int block, float coc_px) {
    Moved& moved = found_[std::size_t(block) % found_.size()];
    if (moved.block != block || std::abs(moved.coc_px - coc_px) > completion_model.step_px / 2)
        moved = textures_.moved_to(x_, y_, block, coc_px);
    return moved;
}

HiddenTextures::Point::Told HiddenTextures::Point::going_on(KnownSurfaces::Place shown) {
    const float rest_px = completion_model.texture_rest_px, least = completion_model.texture_least;
    const float in_focus = std::clamp(completion_model.texture_sharp_px - std::abs(shown.coc_px), 0.0f, 1.0f);
    const HiddenTextures& all = textures_;
    if (all.tiles_.empty() || in_focus <= 0) return {};
    const int block = all.block_at(shown.x, shown.y);
    if (block < 0) return {};
    const Moved& moved = moved_to_here(block, shown.coc_px);
    if (moved.grain <= 0 && moved.alike <= 0) return {};
    const Rgba around = all.mean(shown.x, shown.y);
    const float grain = in_focus * moved.grain;
    Told told;
    if (grain > 0) told = {grain * light_only(around + moved.grain_detail), grain};
    if (moved.alike <= 0) return told;
    Rgba colour = around + moved.detail;
    const float distance = std::hypot(float(x_ - shown.x), float(y_ - shown.y));
    const int u = shown.x + moved.dx, v = shown.y + moved.dy;
    if (distance < 4 * rest_px && all.shows(u, v, shown.coc_px)) {
        const Rgba rest = all.known_.colour(shown.x, shown.y) - around - all.detail_of_pixel(u, v);
        colour += std::exp(-distance / rest_px) * rest;
    }
    const float sure =
        in_focus * std::min(1.0f, (moved.alike - least) / (completion_model.texture_most - least));
    return {(1 - sure) * told.colour + sure * light_only(colour), 1 - (1 - sure) * (1 - told.share)};
}

}  // namespace petzval::engine
