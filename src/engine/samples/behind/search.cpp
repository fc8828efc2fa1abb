#include "engine/samples/behind/search.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"
#include "image/two_sweeps.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {

SurfaceSearch::SurfaceSearch(const KnownSurfaces& known, View<const float> coc,
                             View<const unsigned char> connected, const Mixtures& mixtures, float nearest_px,
                             float farthest_px, Workers& workers)
    : known_(known), coc_(coc), connected_(connected), farthest_(farthest_px) {
    measure_blocks(mixtures, workers);
    lay_paths(std::max(reach_px(nearest_px, farthest_px), completion_model.outline_search_px));
}

float SurfaceSearch::reach_px(float own_px, float behind_px) {
    return std::abs(behind_px - own_px) + NearSilhouettes::kNextPx;
}

void SurfaceSearch::measure_blocks(const Mixtures& mixtures, Workers& workers) {
    const int width = (coc_.width() + kBlock - 1) / kBlock, height = (coc_.height() + kBlock - 1) / kBlock;
    blocks_ = Image<Block>(width, height);
    parallel_for(height, workers, [&](int by) {
        for (int y = by * kBlock; y < std::min((by + 1) * kBlock, coc_.height()); ++y) {
            for (int x = 0; x < coc_.width(); ++x) {
                Block& block = blocks_(x / kBlock, by);
                block.farthest = std::max(block.farthest, known_.radii()(x, y));
                if (known_.is_patch(x, y)) block.free = -kBlock;
            }
            mixtures.for_each_in_row(y,
                                     [&](int x, const Mixture&) { blocks_(x / kBlock, by).free = -kBlock; });
        }
    });
    two_sweeps(width, height, [&](int x, int y, int dx, int dy) {
        blocks_(x, y).free = std::min(blocks_(x, y).free, blocks_(x + dx, y + dy).free + kBlock);
    });
}

// Pixels visited in each direction: every pixel at first, every eighth of the way further out.
void SurfaceSearch::lay_paths(float longest_px) {
    for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * M_PI * k / kDirections;
        Path& path = paths_[std::size_t(k)];
        path.direction = {float(std::cos(angle)), float(std::sin(angle))};
        for (float t = 1; t <= longest_px; t += std::max(1.0f, t / 8)) {
            const int dx = nearest_pixel(t * path.direction.x), dy = nearest_pixel(t * path.direction.y);
            path.steps.push_back({t, dx, dy, std::ptrdiff_t(dy) * coc_.width() + dx});
        }
        for (int t = 0; t <= int(longest_px); ++t)
            path.pixels.push_back(
                {nearest_pixel(float(t) * path.direction.x), nearest_pixel(float(t) * path.direction.y)});
        for (std::size_t i = 0; i < path.steps.size(); ++i)
            while (float(path.at_distance.size()) <= path.steps[i].t) path.at_distance.push_back(i);
    }
}

// True if a silhouette crosses the path from the pixel (x, y) to its pixel at distance t.
bool SurfaceSearch::crosses_silhouette(const Path& path, int x, int y, float t) const {
    for (int i = int(t); i > 0; --i) {
        const auto [u, v] = path.pixels[std::size_t(i)];
        const int free = blocks_((x + u) / kBlock, (y + v) / kBlock).free;
        if (free > 1) {
            i -= free - 1;
            continue;
        }
        const auto [back_u, back_v] = path.pixels[std::size_t(i) - 1];
        if (back_u != u && !(connected_(x + u, y + v) & (back_u > u ? kRight : kLeft))) return true;
        if (back_v != v && !(connected_(x + back_u, y + v) & (back_v > v ? kDown : kUp))) return true;
    }
    return false;
}

std::array<Found, kHits> SurfaceSearch::look(const Start& from, std::size_t k) const {
    const Path& path = paths_[k];
    const auto [x, y, own, slope, at_least_px] = from;
    const float own_per_px = std::max(0.0f, slope.x * path.direction.x + slope.y * path.direction.y);
    float longest = std::max(reach_px(own, farthest_), at_least_px);
    const float* const start = &known_.radii()(x, y);
    std::array<Found, kHits> hits;
    std::size_t n = 0;
    float behind = own;
    const unsigned width = unsigned(coc_.width()), height = unsigned(coc_.height());
    const Step *step = path.steps.data(), *const end = step + path.steps.size();
    // (A part of the pixel's own surface is behind it only if the lens looks past the pixel at that part: the
    // top of a box is behind its front, but the rim of a ball is not behind the ball.)
    const auto is_behind = [&](float coc_px) {
        return step->t <= reach_px(from.own_px, coc_px) || crosses_silhouette(path, from.x, from.y, step->t);
    };
    while (step != end && step->t <= longest) {
        const unsigned u = unsigned(x + step->x), v = unsigned(y + step->y);
        if (u >= width || v >= height) break;
        const Block& block = blocks_(int(u / unsigned(kBlock)), int(v / unsigned(kBlock)));
        // (A block that lies in front completely is skipped without reading its pixels, which saves
        // cache.)
        const float c = block.farthest > behind ? start[step->offset] : behind;
        if (c > behind && c > own + step->t * own_per_px + completion_model.between_px() &&
            (n > 0 || is_behind(c))) {
            hits[n++] = {true, int(u), int(v), c, step->t, known_.slope(int(u), int(v))};
            // (A surface in front of focus hides another one, past whose edges the lens looks in turn.)
            longest = std::min(longest, step->t + std::max(0.0f, -c));
            behind = c + completion_model.step_px;
            if (n == kHits || behind >= farthest_) break;
        }
        // No other surface comes before the next silhouette.
        if (block.free <= 1) {
            ++step;
            continue;
        }
        const std::size_t distance = std::size_t(step->t) + std::size_t(block.free);
        if (distance >= path.at_distance.size()) break;
        step = std::max(step + 1, path.steps.data() + path.at_distance[distance]);
    }
    return hits;
}

}  // namespace petzval::engine
