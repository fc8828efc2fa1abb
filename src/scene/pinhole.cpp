// The pinhole picture with depth, and its hidden surfaces.
#include "base/parallel.h"
#include "scene/lamp_light.h"
#include "scene/tracing.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace petzval::scene {
namespace {

constexpr int kMaxLayers = 24;  // surfaces that one ray is followed through
constexpr int kMaxSteps = 64;   // including surfaces seen from inside
// Hits of one object in one pixel whose depths leave a gap of more than this share belong to separate sheets.
constexpr float kDepthGap = 0.01f;

constexpr float kSkyDepth = 1e10f;  // m: where depth is averaged, in place of infinity

struct PeeledHit {
    std::uint32_t object;
    int ray;
    float depth_m;
    Vec3 radiance;
};

// Data shared by all rows.
struct Tools {
    SobolPoints points;
    LampLight light;
    std::vector<LampImage> lamps;
};

class Row {
public:
    Row(const Pass& pass, const Tools& tools, int y, bool want_layers)
        : pass_(pass), tools_(tools), y_(y), layers_(want_layers ? kMaxLayers : 1) {
        for (const LampImage& lamp : tools.lamps)
            if (lamp.touches({pass.area.x0, y, pass.area.x1, y + 1})) lamps_.push_back(&lamp);
    }

    // The row of the pictures that lies at y in the frame.
    void render(Rgba* colour, float* depth_m) {
        std::vector<Vec3> seen;  // of the pixels that are traced together
        std::vector<float> mean_depths_m;
        for (int x = pass_.area.x0; x < pass_.area.x1; ++x) {
            const std::size_t pixel = std::size_t(x - pass_.area.x0) % std::size_t(together());
            if (pixel == 0) {
                trace_pixels(x);
                seen.assign(std::size_t(together()), {});
                mean_depths_m.assign(std::size_t(together()), 0);
                for (const PeeledHit& hit : first_hits_) {
                    const auto hit_pixel = std::size_t(hit.ray / rays());
                    seen[hit_pixel] += hit.radiance;
                    mean_depths_m[hit_pixel] += std::min(hit.depth_m, kSkyDepth) / float(rays());
                }
            }
            Vec3 sum = seen[pixel] / float(rays());
            if (pass_.depth_is_mean) depth_m[x - pass_.area.x0] = mean_depths_m[pixel];
            const std::size_t before = samples.size();
            for (const LampImage* lamp : lamps_)
                if (lamp->touches({x, y_, x + 1, y_ + 1})) sum += collect_lamp(*lamp, x);
            if (layers_ > 1) collect_surfaces(std::span(samples).subspan(before));
            colour[x - pass_.area.x0] = opaque(sum);
            counts.push_back(samples.size() - before);
            std::sort(samples.begin() + std::ptrdiff_t(before), samples.end(),
                      [](const DeepSample& a, const DeepSample& b) { return a.depth < b.depth; });
        }
        if (!pass_.depth_is_mean) trace_centres(depth_m);
    }

    std::vector<DeepSample> samples;
    std::vector<std::size_t> counts;  // per pixel

private:
    struct Group {
        double inverse_depth = 0;
        Vec3 radiance = {};
        int rays = 0, first_rays = 0;
        double depth_m() const { return rays / inverse_depth; }  // mean of 1/depth, in which CoC is linear
    };

    int rays() const { return tools_.points.count(); }
    // Number of pixels in a packet: several if each has few rays and no layers are collected.
    int together() const { return layers_ > 1 ? 1 : std::max(1, kPacket / rays()); }
    std::uint32_t pixel_seed(int x) const {
        return hash(hash(pass_.seed, std::uint32_t(x)), std::uint32_t(y_));
    }
    void trace_pixels(int x);
    void follow(Packet& packet, int first_ray, int lanes);
    bool note_hit(const Packet& packet, int lane, int ray, bool is_first);
    void collect_surfaces(std::span<const DeepSample> lamps);
    Vec3 collect_lamp(const LampImage& lamp, int x);
    std::vector<Group> groups();
    void trace_centres(float* depth_m) const;

    const Pass& pass_;
    const Tools& tools_;
    int y_, layers_;
    std::vector<const LampImage*> lamps_;
    // Hits of the pixels traced together, rays numbered one pixel after the other: every surface a ray meets,
    // and the first hit, (black) lamps included.
    std::vector<PeeledHit> hits_, first_hits_;
};

void Row::trace_pixels(int x) {
    hits_.clear(), first_hits_.clear();
    const SobolPoints& points = tools_.points;
    const int pixels = std::min(together(), pass_.area.x1 - x), all = pixels * rays();
    for (int i = 0; i < all; i += kPacket) {
        Packet packet(pass_.world);
        const int lanes = std::min(kPacket, all - i);
        for (int lane = 0; lane < lanes; ++lane) {
            const int u = x + (i + lane) / rays();
            const Point4 p = points.at((i + lane) % rays(), pixel_seed(u));
            packet.set(lane, pass_.lens.through(float(u) + p[0], float(y_) + p[1], {}));
        }
        follow(packet, i, lanes);
    }
}

void Row::follow(Packet& packet, int first_ray, int lanes) {
    int found[kPacket] = {}, going = lanes;
    bool active[kPacket] = {};
    std::fill_n(active, lanes, true);
    for (int step = 0; step < kMaxSteps && going > 0; ++step) {
        packet.intersect();
        for (int lane = 0; lane < lanes; ++lane) {
            if (!active[lane]) continue;
            if (note_hit(packet, lane, first_ray + lane, found[lane] == 0)) ++found[lane];
            active[lane] = !packet.missed(lane) && found[lane] < layers_;
            if (active[lane]) {
                packet.step_behind(lane);
            } else {
                packet.retire(lane), --going;
            }
        }
    }
}

// False for invisible hits: solids from inside.
bool Row::note_hit(const Packet& packet, int lane, int ray, bool is_first) {
    const World::Hit hit = packet.hit(lane);
    if (pass_.world.is_inside(hit)) return false;
    const bool lamp = pass_.world.is_lamp(hit.object);
    const PeeledHit peeled{hit.object, ray, packet.depth(lane), lamp ? Vec3{} : pass_.world.radiance(hit)};
    if (is_first) first_hits_.push_back(peeled);
    if (!lamp) hits_.push_back(peeled);
    return true;
}

// Hits of one object without a gap in depth between them. Of a ray that hits a group more than once (tubes
// run into each other) the nearest hit counts.
std::vector<Row::Group> Row::groups() {
    std::sort(hits_.begin(), hits_.end(), [](const PeeledHit& a, const PeeledHit& b) {
        if (a.object != b.object) return a.object < b.object;
        return a.depth_m != b.depth_m ? a.depth_m < b.depth_m : a.ray < b.ray;
    });
    std::vector<float> nearest(std::size_t(rays()), std::numeric_limits<float>::infinity());
    for (const PeeledHit& hit : first_hits_) nearest[std::size_t(hit.ray)] = hit.depth_m;
    std::vector<int> last_group(nearest.size(), -1);
    std::vector<Group> found;
    const PeeledHit* previous = nullptr;
    for (const PeeledHit& hit : hits_) {
        const bool joined = previous && previous->object == hit.object &&
                            (hit.object == World::kSky || hit.depth_m <= previous->depth_m * (1 + kDepthGap));
        if (!joined) found.emplace_back();
        previous = &hit;
        int& seen = last_group[std::size_t(hit.ray)];
        if (seen == int(found.size()) - 1) continue;
        seen = int(found.size()) - 1;
        Group& group = found.back();
        group.inverse_depth += 1 / double(hit.depth_m);
        group.radiance += hit.radiance;
        ++group.rays;
        if (hit.depth_m == nearest[std::size_t(hit.ray)]) ++group.first_rays;
    }
    return found;
}

// lamps: samples of those in the pixel.
void Row::collect_surfaces(std::span<const DeepSample> lamps) {
    const std::vector<Group> found = groups();
    // All rays may miss a lamp that fills little of the pixel.
    float lamp_m = std::numeric_limits<float>::infinity();
    for (const DeepSample& lamp : lamps) lamp_m = std::min(lamp_m, lamp.depth);
    // If only one surface shows, the visible picture is complete; a surface closely behind it would be
    // mistaken for it.
    double behind_m = 0;
    for (const Group& group : found)
        if (group.first_rays == rays() && group.depth_m() < double(lamp_m))
            behind_m = group.depth_m() * double(1 + kDepthGap);
    for (const Group& group : found) {
        if (group.depth_m() < behind_m) continue;
        const float depth_m = float(group.depth_m());
        const Vec3 colour = group.radiance / float(rays());
        samples.push_back(
            {{colour.x, colour.y, colour.z, float(group.rays) / float(rays())}, depth_m, depth_m});
    }
}

// Adds a lamp to the layers and returns its light in the pixel.
Vec3 Row::collect_lamp(const LampImage& lamp, int x) {
    const LampShare share = tools_.light.at(lamp, x, y_, pixel_seed(x));
    const Vec3 own = share.unhindered * lamp.lamp.radiance;
    const float depth_m = lamp.centre.z;
    if (layers_ > 1 && share.unhindered > 0)
        samples.push_back({{own.x, own.y, own.z, std::min(1.0f, share.unhindered)}, depth_m, depth_m});
    return share.seen * lamp.lamp.radiance;
}

void Row::trace_centres(float* depth_m) const {
    const int width = pass_.area.width();
    for (int x = 0; x < width; x += kPacket) {
        Packet packet(pass_.world);
        const int lanes = std::min(kPacket, width - x);
        for (int lane = 0; lane < lanes; ++lane)
            packet.set(lane,
                       pass_.lens.through(float(pass_.area.x0 + x + lane) + 0.5f, float(y_) + 0.5f, {}));
        packet.intersect();
        for (int lane = 0; lane < lanes; ++lane) depth_m[x + lane] = packet.depth(lane);
    }
}

}  // namespace

bool render_pinhole(const Pass& pass, Picture& colour, Plane& depth_m, DeepPicture* layers) {
    const int width = pass.area.width(), height = pass.area.height();
    colour = Picture::uninitialised(width, height);
    depth_m = Plane::uninitialised(width, height);
    LensRays pinhole = pass.lens;
    pinhole.aperture_radius_m = 0;
    const int sharp_samples = pass.world.is_baked ? 1024 : std::clamp(16 * pass.samples, 64, 1024);
    const Tools tools{SobolPoints(pass.samples), LampLight(pass.world, pinhole, pass.samples, sharp_samples),
                      lamp_images(pass.world, pinhole, pass.area)};
    std::vector<std::vector<DeepSample>> samples(layers ? std::size_t(height) : 0);
    std::vector<std::vector<std::size_t>> counts(samples.size());
    parallel_for(height, pass.workers, [&](int y) {
        if (pass.progress.cancelled()) return;
        Row row(pass, tools, pass.area.y0 + y, layers != nullptr);
        row.render(colour.row(y), depth_m.row(y));
        if (layers) {
            samples[std::size_t(y)] = std::move(row.samples);
            counts[std::size_t(y)] = std::move(row.counts);
        }
        pass.progress.advance(pass.share / height);
    });
    if (pass.progress.cancelled()) return false;
    if (layers) {
        std::vector<std::size_t> first{0};
        std::vector<DeepSample> all;
        for (std::size_t y = 0; y < samples.size(); ++y) {
            for (const std::size_t count : counts[y]) first.push_back(first.back() + count);
            all.insert(all.end(), samples[y].begin(), samples[y].end());
            samples[y] = {};
        }
        *layers = DeepPicture(width, height, std::move(first), std::move(all));
    }
    return true;
}

}  // namespace petzval::scene
