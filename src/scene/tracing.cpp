#include "scene/tracing.h"

#include <limits>

namespace petzval::scene {

void Packet::set(int lane, const LensRays::Ray& ray, float far) {
    const Vec3 o = world_.view.position + world_.view.to_world(ray.origin);
    const Vec3 d = world_.view.to_world(ray.direction);
    RTCRay16& r = packet_.ray;
    r.org_x[lane] = o.x, r.org_y[lane] = o.y, r.org_z[lane] = o.z;
    r.dir_x[lane] = d.x, r.dir_y[lane] = d.y, r.dir_z[lane] = d.z;
    r.tnear[lane] = 0, r.tfar[lane] = far, r.time[lane] = 0;
    r.mask[lane] = ~0u, r.id[lane] = 0, r.flags[lane] = 0;
    valid_[lane] = -1;
}

void Packet::intersect() {
    for (int i = 0; i < kPacket; ++i) {
        packet_.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        packet_.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        if (valid_[i]) packet_.ray.tfar[i] = std::numeric_limits<float>::infinity();
    }
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid_, world_.rays(), &context, &packet_);
}

void Packet::test_occlusion() {
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid_, world_.rays(), &context, &packet_.ray);
}

World::Hit Packet::hit(int lane) const {
    const RTCRay16& r = packet_.ray;
    const RTCHit16& h = packet_.hit;
    World::Hit hit{h.geomID[lane], h.primID[lane], h.u[lane], h.v[lane], {}, {}, {}, false};
    hit.direction = {r.dir_x[lane], r.dir_y[lane], r.dir_z[lane]};
    if (hit.object == World::kSky) return hit;
    hit.position = Vec3{r.org_x[lane], r.org_y[lane], r.org_z[lane]} + r.tfar[lane] * hit.direction;
    hit.normal = {h.Ng_x[lane], h.Ng_y[lane], h.Ng_z[lane]};
    return hit;
}

void Packet::step_behind(int lane) {
    // A hit is found again at almost the same place, up to rounding.
    packet_.ray.tnear[lane] = packet_.ray.tfar[lane] * (1 + 1e-5f);
}

void Packet::retire(int lane) { valid_[lane] = 0; }

}  // namespace petzval::scene
