// A pixel's light from a lamp is an integral over pixel points p, pupil points u and lamp points s joined by
// p = image of s + radius * u: two of the three are free, the third follows. Drawing the two that spread
// least on the sensor and solving for the one that spreads most wastes the fewest rays; its factor is the
// area on the sensor of the two drawn over that of pixel and lens, the pair that defines the average.
#include "scene/lamp_light.h"

#include <algorithm>
#include <cmath>

namespace petzval::scene {
namespace {

constexpr int kFirstSamples = 64;  // where these agree (all of the lamp seen, or none), no more are taken
constexpr float kSharpRadius = 3;  // px

}  // namespace

bool LampImage::touches(const Rect& area) const {
    const float reach = reach_px();
    return x + reach > float(area.x0) && x - reach < float(area.x1) && y + reach > float(area.y0) &&
           y - reach < float(area.y1);
}

std::vector<LampImage> lamp_images(const World& world, const LensRays& lens, const Rect& area) {
    std::vector<LampImage> images;
    for (const Lamp& lamp : world.lamps()) {
        const Vec3 c = world.view.from_world(lamp.centre);
        if (c.z <= 0) continue;
        const LampImage image{
            lamp, c, lens.image_x(c), lens.image_y(c), lamp.radius_m / c.z / lens.pixel, lens.radius_px(c.z)};
        if (image.touches(area)) images.push_back(image);
    }
    return images;
}

LampLight::LampLight(const World& world, const LensRays& lens, int disc_samples, int sharp_samples)
    : world_(world),
      lens_(lens),
      disc_points_(disc_samples),
      sharp_points_(std::max(disc_samples, sharp_samples)) {}

LampShare LampLight::at(const LampImage& image, int x, int y, std::uint32_t seed) const {
    const float dx = float(x) + 0.5f - image.x, dy = float(y) + 0.5f - image.y;
    const float reach = image.reach_px() + 0.71f;  // half a pixel's diagonal
    if (dx * dx + dy * dy > reach * reach) return {};
    const float lamp_area = kPi * image.lamp_radius_px * image.lamp_radius_px;
    const float blur_area = kPi * image.coc_radius_px * image.coc_radius_px;
    const float largest = std::max({1.0f, lamp_area, blur_area});
    const Solved solved = largest == 1 ? Solved::Pixel : largest == lamp_area ? Solved::Lamp : Solved::Lens;
    const float factor = solved == Solved::Pixel  ? lamp_area
                         : solved == Solved::Lens ? lamp_area / blur_area
                                                  : 1;

    const SobolPoints& points = std::abs(image.coc_radius_px) < kSharpRadius ? sharp_points_ : disc_points_;
    int met = 0, seen = 0, done = 0;
    while (done < points.count() && !(done == kFirstSamples && met == done && (seen == done || seen == 0))) {
        Packet packet(world_);
        bool set[kPacket] = {};
        const int lanes = std::min(kPacket, points.count() - done);
        for (int lane = 0; lane < lanes; ++lane) {
            LensRays::Ray ray;
            set[lane] = aim(solved, image, x, y, points.at(done + lane, seed), ray);
            if (set[lane]) packet.set(lane, ray, image.centre.z * (1 - 1e-4f)), ++met;
        }
        packet.test_occlusion();
        for (int lane = 0; lane < kPacket; ++lane) seen += set[lane] && !packet.blocked(lane);
        done += lanes;
    }
    const float per_ray = factor / float(done);
    return {per_ray * float(met), per_ray * float(seen)};
}

// The ray for a sample point; false where the solved quantity falls outside its square or disc.
bool LampLight::aim(Solved solved, const LampImage& image, int x, int y, const Point4& point,
                    LensRays::Ray& ray) const {
    const auto outside_disc = [](float a, float b) { return a * a + b * b > 1; };
    const DiscPoint first = disc_point(point[0], point[1]);
    if (solved == Solved::Lamp) {
        ray = lens_.through(float(x) + point[2], float(y) + point[3], first);
        const Vec3 off = (ray.origin + image.centre.z * ray.direction - image.centre) / image.lamp.radius_m;
        return !outside_disc(off.x, off.y);
    }
    const Vec3 target = image.centre + image.lamp.radius_m * Vec3{first.x, first.y, 0};
    if (solved == Solved::Lens) {
        const float px = float(x) + point[2], py = float(y) + point[3];
        const DiscPoint u{(px - lens_.image_x(target)) / image.coc_radius_px,
                          (lens_.image_y(target) - py) / image.coc_radius_px};
        ray = lens_.through(px, py, u);
        return !outside_disc(u.x, u.y);
    }
    const DiscPoint u = disc_point(point[2], point[3]);
    const float px = lens_.image_x(target) + image.coc_radius_px * u.x;
    const float py = lens_.image_y(target) - image.coc_radius_px * u.y;
    ray = lens_.through(px, py, u);
    return px >= float(x) && px < float(x + 1) && py >= float(y) && py < float(y + 1);
}

}  // namespace petzval::scene
