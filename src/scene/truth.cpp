// What the lens records: rays through every part of the aperture, averaged over each pixel's square.
//
// Surfaces are sampled by rays through (pixel, lens) points, in tiles that stop early once doubling the
// samples no longer changes them. A lamp is a needle in that haystack (a pixel inside its disc sees it
// through a thousandth of the lens), so lamps add nothing there: each is integrated on its own over the
// pixels its disc touches, by rays from the lens to points of the lamp, with whatever stands between.
#include "base/parallel.h"
#include "scene/tracing.h"

#include <algorithm>
#include <vector>

namespace petzval::scene {
namespace {

constexpr int kTile = 8;
constexpr int kFirstSamples = 64;
// Mean difference between two independent halves, relative to 1 + the value, at which a tile is done: 0.0015
// of white is 56 dB.
constexpr float kTolerance = 0.0015f;

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

// How far the means of two runs differ, in a measure that an HDR pixel does not dominate.
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

// A lamp as the camera sees it.
struct LampImage {
    Lamp lamp;
    Vec3 centre;  // camera space
    float x, y, lamp_radius_px, coc_radius_px;
    // The disc that its light fills on the sensor.
    float reach_px() const { return lamp_radius_px + std::abs(coc_radius_px); }
};

std::vector<LampImage> lamp_images(const Pass& pass) {
    std::vector<LampImage> images;
    for (const Lamp& lamp : pass.world.lamps()) {
        const Vec3 c = pass.world.view.from_world(lamp.centre);
        if (c.z <= 0) continue;
        const LampImage image{lamp,
                              c,
                              pass.lens.image_x(c),
                              pass.lens.image_y(c),
                              lamp.radius_m / c.z / pass.lens.pixel,
                              pass.lens.radius_px(c.z)};
        const float reach = image.reach_px();
        if (image.x + reach > 0 && image.x - reach < float(pass.width) && image.y + reach > 0 &&
            image.y - reach < float(pass.height))
            images.push_back(image);
    }
    return images;
}

// The light of one lamp in pixel (x, y). For a pixel point p and a lamp point s there is one pupil point u
// that joins them: p = image of s + radius * u. Averaging over p and s costs a factor of lamp area / (pi
// radius^2); where that exceeds 1 (the lamp is larger than its blur) averaging over p and u is the smoother
// sum.
class LampIntegral {
public:
    LampIntegral(const Pass& pass, const SobolPoints& points) : pass_(pass), points_(points) {}

    Vec3 at(const LampImage& image, int x, int y, std::uint32_t seed) const {
        const bool by_lamp_points = image.lamp_radius_px < std::abs(image.coc_radius_px);
        int seen = 0;
        for (int i = 0; i < points_.count(); i += kPacket) {
            Packet packet(pass_.world);
            const int lanes = std::min(kPacket, points_.count() - i);
            bool set[kPacket] = {};
            for (int lane = 0; lane < lanes; ++lane) {
                const Point4 p = points_.at(i + lane, seed);
                const float px = float(x) + p[2], py = float(y) + p[3];
                const DiscPoint d = disc_point(p[0], p[1]);
                set[lane] = by_lamp_points ? aim(packet, lane, image, px, py, d)
                                           : look(packet, lane, image, px, py, d);
            }
            packet.test_occlusion();
            for (int lane = 0; lane < lanes; ++lane) seen += set[lane] && !packet.blocked(lane);
        }
        const float ratio = image.lamp_radius_px / image.coc_radius_px;
        const float factor = by_lamp_points ? ratio * ratio : 1;
        return factor * float(seen) / float(points_.count()) * image.lamp.radiance;
    }

private:
    // From the pupil point that sees lamp point s at (px, py), if it is inside the pupil.
    bool aim(Packet& packet, int lane, const LampImage& image, float px, float py, DiscPoint s) const {
        const Vec3 target = image.centre + image.lamp.radius_m * Vec3{s.x, s.y, 0};
        const DiscPoint u{(px - pass_.lens.image_x(target)) / image.coc_radius_px,
                          (pass_.lens.image_y(target) - py) / image.coc_radius_px};
        if (u.x * u.x + u.y * u.y > 1) return false;
        send(packet, lane, pass_.lens.through(px, py, u), image);
        return true;
    }

    // From pupil point u, if the ray through (px, py) meets the lamp.
    bool look(Packet& packet, int lane, const LampImage& image, float px, float py, DiscPoint u) const {
        const LensRays::Ray ray = pass_.lens.through(px, py, u);
        const Vec3 off = ray.origin + image.centre.z * ray.direction - image.centre;
        if (off.x * off.x + off.y * off.y > image.lamp.radius_m * image.lamp.radius_m) return false;
        send(packet, lane, ray, image);
        return true;
    }

    static void send(Packet& packet, int lane, const LensRays::Ray& ray, const LampImage& image) {
        packet.set(lane, ray, image.centre.z * (1 - 1e-4f));
    }

    const Pass& pass_;
    const SobolPoints& points_;
};

void add_lamps(const Pass& pass, const std::vector<LampImage>& lamps, const LampIntegral& integral,
               const Tile& tile, std::vector<Vec3>& out) {
    for (const LampImage& image : lamps) {
        const float reach = image.reach_px() + 0.71f;  // half a pixel's diagonal
        if (image.x + reach < float(tile.area.x0) || image.x - reach > float(tile.area.x1) ||
            image.y + reach < float(tile.area.y0) || image.y - reach > float(tile.area.y1))
            continue;
        const std::uint32_t lamp_seed = hash(pass.seed ^ 0x2545f491u, std::uint32_t(&image - lamps.data()));
        for (int i = 0; i < tile.count(); ++i) {
            const float dx = float(tile.x(i)) + 0.5f - image.x, dy = float(tile.y(i)) + 0.5f - image.y;
            if (dx * dx + dy * dy > reach * reach) continue;
            out[std::size_t(i)] +=
                integral.at(image, tile.x(i), tile.y(i), pixel_seed(pass, tile.x(i), tile.y(i)) ^ lamp_seed);
        }
    }
}

}  // namespace

bool render_truth(const Pass& pass, Picture& truth) {
    truth = Picture::uninitialised(pass.width, pass.height);
    const SobolPoints points(pass.samples), lamp_points(std::max(kFirstSamples, pass.samples / 8));
    const std::vector<LampImage> lamps = lamp_images(pass);
    const LampIntegral integral(pass, lamp_points);
    const int columns = (pass.width + kTile - 1) / kTile, rows = (pass.height + kTile - 1) / kTile;
    parallel_for(columns * rows, pass.threads, [&](int index) {
        if (pass.progress.cancelled()) return;
        const int x = index % columns * kTile, y = index / columns * kTile;
        const Tile tile{Rect{x, y, x + kTile, y + kTile}.intersected(truth.rect())};
        std::vector<Vec3> radiance(std::size_t(tile.count()));
        render_surfaces(pass, points, tile, radiance);
        add_lamps(pass, lamps, integral, tile, radiance);
        for (int i = 0; i < tile.count(); ++i) truth(tile.x(i), tile.y(i)) = opaque(radiance[std::size_t(i)]);
        pass.progress.advance(pass.share / (columns * rows));
    });
    return !pass.progress.cancelled();
}

}  // namespace petzval::scene
