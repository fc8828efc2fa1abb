// Renders the lens's true picture: rays through every part of the aperture, averaged over each pixel's
// square.
//
// Surfaces are sampled by rays through (pixel, lens) points, in tiles that stop early once doubling the
// samples no longer changes them. Rays would hardly ever hit a lamp, so lamps are black there and are added
// separately (lamp_light.h).
#include "base/parallel.h"
#include "scene/lamp_light.h"
#include "scene/tracing.h"

#include <algorithm>
#include <vector>

namespace petzval::scene {
namespace {

constexpr int kTile = 8;
constexpr int kFirstSamples = 64;
// Mean difference between two independent halves, relative to 1 + the value, at which a tile is done: 0.002
// of white is 54 dB.
constexpr float kTolerance = 0.002f;

struct Tile {
    Rect area;
    int count() const { return area.width() * area.height(); }
    int x(int i) const { return area.x0 + i % area.width(); }
    int y(int i) const { return area.y0 + i / area.width(); }
};

std::uint32_t pixel_seed(const Pass& pass, int x, int y) {
    return hash(hash(pass.seed ^ 0x51ed270bu, std::uint32_t(x)), std::uint32_t(y));
}

// Sum over samples [first, last) of the surfaces, lamps left out.
Vec3 surface_sum(const Pass& pass, const SobolPoints& points, int x, int y, int first, int last) {
    const std::uint32_t seed = pixel_seed(pass, x, y);
    Vec3 sum;
    for (int i = first; i < last; i += kPacket) {
        Packet packet(pass.world);
        const int lanes = std::min(kPacket, last - i);
        for (int lane = 0; lane < lanes; ++lane) {
            const Point4 p = points.at(i + lane, seed);
            packet.set(lane, pass.lens.through(float(x) + p[2], float(y) + p[3], disc_point(p[0], p[1])));
        }
        packet.intersect();
        for (int lane = 0; lane < lanes; ++lane) {
            const World::Hit hit = packet.hit(lane);
            if (!pass.world.is_lamp(hit.object)) sum += pass.world.radiance(hit);
        }
    }
    return sum;
}

// Difference between the means of two runs, in a measure that an HDR pixel does not dominate.
float disagreement(Vec3 a, Vec3 b) {
    const auto one = [](float p, float q) {
        const float d = (p - q) / (1 + std::max(p, q));
        return d * d;
    };
    return (one(a.x, b.x) + one(a.y, b.y) + one(a.z, b.z)) / 3;
}

void render_surfaces(const Pass& pass, const SobolPoints& points, const Tile& tile, std::vector<Vec3>& out) {
    int done = std::min(kFirstSamples, points.count());
    std::vector<Vec3> sums(std::size_t(tile.count()));
    for (int i = 0; i < tile.count(); ++i)
        sums[std::size_t(i)] = surface_sum(pass, points, tile.x(i), tile.y(i), 0, done);
    float error = 1;
    while (done < points.count() && error > kTolerance * kTolerance) {
        const int next = std::min(2 * done, points.count());
        error = 0;
        for (int i = 0; i < tile.count(); ++i) {
            Vec3& sum = sums[std::size_t(i)];
            const Vec3 more = surface_sum(pass, points, tile.x(i), tile.y(i), done, next);
            error += disagreement(sum / float(done), more / float(next - done)) / float(tile.count());
            sum += more;
        }
        done = next;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) out[i] = sums[i] / float(done);
}

void add_lamps(const Pass& pass, const std::vector<LampImage>& lamps, const LampLight& light,
               const Tile& tile, std::vector<Vec3>& out) {
    for (std::size_t l = 0; l < lamps.size(); ++l) {
        if (!lamps[l].touches(tile.area)) continue;
        const std::uint32_t lamp_seed = hash(pass.seed, std::uint32_t(l));
        for (int i = 0; i < tile.count(); ++i) {
            const std::uint32_t seed = pixel_seed(pass, tile.x(i), tile.y(i)) ^ lamp_seed;
            out[std::size_t(i)] +=
                light.at(lamps[l], tile.x(i), tile.y(i), seed).seen * lamps[l].lamp.radiance;
        }
    }
}

}  // namespace

bool render_truth(const Pass& pass, Picture& truth) {
    truth = Picture::uninitialised(pass.area.width(), pass.area.height());
    const SobolPoints points(pass.samples);
    const std::vector<LampImage> lamps = lamp_images(pass.world, pass.lens, pass.area);
    const LampLight light(pass.world, pass.lens, std::max(kFirstSamples, pass.samples / 2));
    const int columns = (truth.width() + kTile - 1) / kTile, rows = (truth.height() + kTile - 1) / kTile;
    parallel_for(columns * rows, pass.workers, [&](int index) {
        if (pass.progress.cancelled()) return;
        const int x = pass.area.x0 + index % columns * kTile, y = pass.area.y0 + index / columns * kTile;
        const Tile tile{Rect{x, y, x + kTile, y + kTile}.intersected(pass.area)};
        std::vector<Vec3> radiance(std::size_t(tile.count()));
        render_surfaces(pass, points, tile, radiance);
        add_lamps(pass, lamps, light, tile, radiance);
        for (int i = 0; i < tile.count(); ++i)
            truth(tile.x(i) - pass.area.x0, tile.y(i) - pass.area.y0) = opaque(radiance[std::size_t(i)]);
        pass.progress.advance(pass.share / (columns * rows));
    });
    return !pass.progress.cancelled();
}

}  // namespace petzval::scene
