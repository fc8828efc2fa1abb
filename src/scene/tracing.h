// Rays in packets of sixteen, and the pieces that the three passes (pinhole, layers, truth) share.
#pragma once

#include "petzval/deep.h"
#include "petzval/image.h"
#include "petzval/motion.h"
#include "petzval/workers.h"

#include "base/progress.h"
#include "scene/optics.h"
#include "scene/sampling.h"
#include "scene/world.h"

namespace petzval::scene {

constexpr int kPacket = 16;

// Up to sixteen rays of camera space on their way through the world.
class Packet {
public:
    explicit Packet(const World& world) : world_(world) {}
    void set(int lane, const LensRays::Ray& ray, float far = std::numeric_limits<float>::infinity());
    // Finds the nearest hit of each set lane beyond where it stands.
    void intersect();
    // Afterwards blocked(lane) is true if anything lies between a lane's start and its far end.
    void test_occlusion();
    bool blocked(int lane) const { return packet_.ray.tfar[lane] < 0; }

    float depth(int lane) const { return packet_.ray.tfar[lane]; }  // +infinity for a miss
    World::Hit hit(int lane) const;
    bool missed(int lane) const { return packet_.hit.geomID[lane] == World::kSky; }
    // Lets a lane continue behind its hit, or rest.
    void step_behind(int lane);
    void retire(int lane);

private:
    const World& world_;
    RTCRayHit16 packet_{};
    alignas(64) int valid_[kPacket] = {};
};

inline Rgba opaque(Vec3 c) { return {c.x, c.y, c.z, 1}; }

// Inputs of every pass. Passes return false if they were cancelled.
struct Pass {
    const World& world;
    LensRays lens;
    Rect area;  // the pixels to make, in those of the frame; wider than it with overscan
    int samples = 0;
    std::uint32_t seed = 0;
    Workers& workers;
    Progress& progress;
    double share = 0;  // of the whole work
    bool depth_is_mean = false;
};

// Pinhole colour and depth, and the layers (see RenderedScene) when `layers` is not null.
bool render_pinhole(const Pass& pass, Picture& colour, Plane& depth_m, DeepPicture* layers);
bool render_truth(const Pass& pass, Picture& truth);
// Motion of visible surfaces to their place in `other`: the same objects at another time, seen by its view.
Image<PixelMove> render_motion(const Pass& pass, const World& other);

}  // namespace petzval::scene
