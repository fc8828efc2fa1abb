#include "scene/world.h"

#include "base/check.h"
#include "base/parallel.h"
#include "image/srgb.h"
#include "scene/sampling.h"

#include <limits>
#include <new>

namespace petzval::scene {
namespace {

constexpr int kBakeRays = 64;  // per vertex, and per light
const SobolPoints& bake_points() {
    static const SobolPoints points(kBakeRays);
    return points;
}

RTCRay ray(Vec3 from, Vec3 direction, float near, float far) {
    RTCRay r{};
    r.org_x = from.x, r.org_y = from.y, r.org_z = from.z;
    r.dir_x = direction.x, r.dir_y = direction.y, r.dir_z = direction.z;
    r.tnear = near, r.tfar = far, r.mask = ~0u;
    return r;
}

void* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
             std::size_t count) {
    void* memory = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

struct World::Object {
    Mesh mesh;    // empty for tubes
    Tubes tubes;  // empty for meshes
    std::vector<Vec3> irradiance;
    Paint paint;
    Sides sides = Sides::Solid;
    Cutout cutout;  // empty: whole
};

namespace {

Vec3 code(Vec3 light) {
    const auto of = [](float v) { return srgb_code(std::max(v, 0.0f)); };
    return {of(light.x), of(light.y), of(light.z)};
}

}  // namespace

void World::light_in_codes() {
    PETZVAL_CHECK(is_baked && !is_in_codes_);
    for (Lamp& lamp : lamps_) lamp.radiance = code(lamp.radiance);
    is_in_codes_ = true;
}

Arrival arrival(const Light& light, Vec3 position) {
    if (light.distant) return {normalised(light.position), light.power};
    const Vec3 towards = light.position - position;
    return {towards, light.power / std::max(dot(towards, towards), 1e-4f)};
}

Viewpoint Viewpoint::looking(Vec3 from, Vec3 at) {
    Viewpoint v{.position = from};
    v.forward = normalised(at - from);
    v.right = normalised(cross({0, 1, 0}, v.forward));
    v.up = cross(v.forward, v.right);
    return v;
}

// With wider instructions than AVX2, Embree rounds some hits otherwise: a scene would depend on the
// processor.
World::World(bool one_thread)
    : device_(rtcNewDevice(one_thread ? "max_isa=avx2,threads=1" : "max_isa=avx2")) {
    // Embree needs nothing but memory and threads for either.
    if (device_ != nullptr) rays_ = rtcNewScene(device_);
    if (rays_ == nullptr) {
        if (device_ != nullptr) rtcReleaseDevice(device_);
        throw std::bad_alloc();
    }
    rtcSetSceneFlags(rays_, RTC_SCENE_FLAG_ROBUST);  // no ray may slip through between two triangles
}

World::~World() {
    rtcReleaseScene(rays_);
    rtcReleaseDevice(device_);
}

// Embree asks before it takes a hit.
void World::open_holes(const RTCFilterFunctionNArguments* hits) {
    const Object& object = *static_cast<const Object*>(hits->geometryUserPtr);
    for (unsigned i = 0; i < hits->N; ++i) {
        if (hits->valid[i] != -1) continue;
        const auto& t = object.mesh.triangles[RTCHitN_primID(hits->hit, hits->N, i)];
        const float b = RTCHitN_u(hits->hit, hits->N, i), c = RTCHitN_v(hits->hit, hits->N, i);
        const auto& uv = object.mesh.uv;
        const auto at = [&](std::size_t k) {
            return (1 - b - c) * uv[t[0]][k] + b * uv[t[1]][k] + c * uv[t[2]][k];
        };
        if (!object.cutout(at(0), at(1))) hits->valid[i] = 0;
    }
}

RTCGeometry World::new_geometry(RTCGeometryType type) const {
    RTCGeometry geometry = rtcNewGeometry(device_, type);
    if (geometry == nullptr) throw std::bad_alloc();
    return geometry;
}

unsigned World::attach(RTCGeometry geometry) const {
    rtcCommitGeometry(geometry);
    const unsigned id = rtcAttachGeometry(rays_, geometry);
    if (id == RTC_INVALID_GEOMETRY_ID) throw std::bad_alloc();
    rtcReleaseGeometry(geometry);
    return id;
}

void World::add(Mesh mesh, Paint paint, Sides sides, Cutout cutout) {
    RTCGeometry geometry = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<Vec3*>(
        buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, sizeof(Vec3), mesh.positions.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), vertices);
    auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
        buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    auto object =
        std::make_unique<Object>(Object{std::move(mesh), {}, {}, std::move(paint), sides, std::move(cutout)});
    if (object->cutout) {
        rtcSetGeometryUserData(geometry, object.get());
        rtcSetGeometryIntersectFilterFunction(geometry, open_holes);
        rtcSetGeometryOccludedFilterFunction(geometry, open_holes);
    }
    PETZVAL_CHECK(attach(geometry) == objects_.size());
    objects_.push_back(std::move(object));
}

void World::add(Tubes tubes, Paint paint) {
    RTCGeometry geometry = new_geometry(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    auto* vertices = static_cast<Tubes::Point*>(buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4,
                                                       sizeof(Tubes::Point), tubes.points.size()));
    std::copy(tubes.points.begin(), tubes.points.end(), vertices);
    auto* segments = static_cast<std::uint32_t*>(
        buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, 4, tubes.segments.size()));
    std::copy(tubes.segments.begin(), tubes.segments.end(), segments);
    PETZVAL_CHECK(attach(geometry) == objects_.size());
    objects_.push_back(
        std::make_unique<Object>(Object{{}, std::move(tubes), {}, std::move(paint), Sides::Solid, {}}));
}

void World::add_lamp(Vec3 centre, float radius_m, Vec3 radiance) {
    lamps_.push_back({centre, radius_m, radiance});
}

void World::attach_lamps() {
    if (lamps_.empty()) return;
    RTCGeometry geometry = new_geometry(RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* discs = static_cast<Tubes::Point*>(
        buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, sizeof(Tubes::Point), lamps_.size()));
    auto* normals = static_cast<Vec3*>(
        buffer(geometry, RTC_BUFFER_TYPE_NORMAL, RTC_FORMAT_FLOAT3, sizeof(Vec3), lamps_.size()));
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        discs[i] = {lamps_[i].centre, lamps_[i].radius_m};
        normals[i] = -view.forward;
    }
    lamp_normals_ = normals;
    lamp_object_ = attach(geometry);
}

Status World::look_from(const Viewpoint& from) {
    const bool is_other = !(from == view);
    view = from;
    if (lamp_object_ == kSky || !is_other) return Done{};
    for (std::size_t i = 0; i < lamps_.size(); ++i) lamp_normals_[i] = -view.forward;
    RTCGeometry geometry = rtcGetGeometry(rays_, lamp_object_);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0);
    rtcCommitGeometry(geometry);
    return commit_rays();
}

Status World::commit_rays() {
    rtcCommitScene(rays_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
        return Error{ErrorCode::OutOfMemory, "the scene's ray tracing structure does not fit the memory"};
    return Done{};
}

Status World::commit(Workers& workers) {
    attach_lamps();
    if (Status done = commit_rays(); !done) return done;
    if (is_baked) bake(workers);
    return Done{};
}

// Adds irradiance(position, normal, seed) to each vertex once all are known, so that it may look at the
// others.
template <typename Irradiance>
void World::for_each_vertex(Workers& workers, const Irradiance& irradiance) {
    constexpr int kPiece = 64;  // vertices
    std::vector<std::vector<Vec3>> added(objects_.size());
    for (std::size_t o = 0; o < objects_.size(); ++o) {
        const Object& object = *objects_[o];
        const int count = int(object.mesh.positions.size());
        added[o].resize(std::size_t(count));
        parallel_for((count + kPiece - 1) / kPiece, workers, [&](int piece) {
            for (int v = piece * kPiece; v < std::min(count, (piece + 1) * kPiece); ++v) {
                const Vec3 p = object.mesh.positions[std::size_t(v)], n = object.mesh.normals[std::size_t(v)];
                // The same rays for all of an object: their error varies as smoothly as the surface.
                const std::uint32_t seed = hash(std::uint32_t(o), 0);
                Vec3& sum = added[o][std::size_t(v)];
                sum = irradiance(p, n, seed);
                if (object.sides == Sides::Leaf) sum = 0.6f * (sum + irradiance(p, -n, seed));
            }
        });
    }
    for (std::size_t o = 0; o < objects_.size(); ++o)
        for (std::size_t v = 0; v < added[o].size(); ++v) objects_[o]->irradiance[v] += added[o][v];
}

void World::bake(Workers& workers) {
    for (auto& object : objects_) object->irradiance.assign(object->mesh.positions.size(), {});
    for_each_vertex(workers,
                    [&](Vec3 p, Vec3 n, std::uint32_t seed) { return direct_irradiance(p, n, seed); });
    for_each_vertex(workers,
                    [&](Vec3 p, Vec3 n, std::uint32_t seed) { return indirect_irradiance(p, n, seed); });
}

Vec3 World::direct_irradiance(Vec3 position, Vec3 normal, std::uint32_t seed) const {
    const Vec3 from = position + 1e-3f * normal;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    Vec3 sum;
    for (const Light& light : lights) {
        const Arrival a = arrival(light, position);
        const Vec3 across = normalised(cross(a.towards, {0.31f, 0.87f, 0.38f}));
        const Vec3 other = normalised(cross(a.towards, across));
        for (int i = 0; i < kBakeRays; ++i) {
            const Point4 point = bake_points().at(i, seed);
            const DiscPoint spot = disc_point(point[2], point[3]);
            const Vec3 towards = a.towards + light.radius * (spot.x * across + spot.y * other);
            const float cosine = dot(normal, normalised(towards));
            if (cosine <= 0) continue;
            RTCRay shadow =
                ray(from, towards, 0, light.distant ? std::numeric_limits<float>::infinity() : 0.999f);
            rtcOccluded1(rays_, &context, &shadow);
            if (shadow.tfar >= 0) sum += cosine * a.facing;
        }
    }
    return sum / float(kBakeRays);
}

// Irradiance from the sky and from surfaces in direct light.
Vec3 World::indirect_irradiance(Vec3 position, Vec3 normal, std::uint32_t seed) const {
    const Vec3 from = position + 1e-3f * normal;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    Vec3 sum;
    for (int i = 0; i < kBakeRays; ++i) {
        const Point4 point = bake_points().at(i, seed);
        const Vec3 direction = cosine_direction(normal, point[0], point[1]);
        RTCRayHit around{};
        around.ray = ray(from, direction, 0, std::numeric_limits<float>::infinity());
        around.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(rays_, &context, &around);
        if (is_lamp(around.hit.geomID)) continue;
        const Vec3 arriving = light({around.hit.geomID,
                                     around.hit.primID,
                                     around.hit.u,
                                     around.hit.v,
                                     from + around.ray.tfar * direction,
                                     {around.hit.Ng_x, around.hit.Ng_y, around.hit.Ng_z},
                                     direction});
        sum += std::min(1.0f, brightest_bounce / std::max(luminance(arriving), 1e-9f)) * arriving;
    }
    return kPi * sum / float(kBakeRays);
}

Vec3 World::tube_irradiance(Vec3 position, Vec3 normal) const {
    Vec3 sum = mix(ambient_below, ambient_above, 0.5f + 0.5f * normal.y);
    for (const Light& light : lights) {
        if (!light.lights_tubes) continue;
        const Arrival a = arrival(light, position);
        sum += std::max(0.0f, dot(normal, normalised(a.towards))) * a.facing;
    }
    return sum;
}

std::optional<Vec3> World::moved_in(const World& other, const Hit& hit) const {
    if (hit.object == kSky) return Vec3{};
    if (is_lamp(hit.object)) {
        if (other.lamps_.size() != lamps_.size()) return std::nullopt;
        return other.lamps_[hit.primitive].centre - lamps_[hit.primitive].centre;
    }
    if (other.objects_.size() != objects_.size()) return std::nullopt;
    const Object &own = *objects_[hit.object], &theirs = *other.objects_[hit.object];
    const auto &a = own.mesh.positions, &b = theirs.mesh.positions;
    const auto &p = own.tubes.points, &q = theirs.tubes.points;
    if (a.size() != b.size() || p.size() != q.size()) return std::nullopt;
    if (!a.empty()) {
        const auto& t = own.mesh.triangles[hit.primitive];
        return (1 - hit.u - hit.v) * (b[t[0]] - a[t[0]]) + hit.u * (b[t[1]] - a[t[1]]) +
               hit.v * (b[t[2]] - a[t[2]]);
    }
    const std::size_t first = own.tubes.segments[hit.primitive];
    return (1 - hit.u) * (q[first].position - p[first].position) +
           hit.u * (q[first + 1].position - p[first + 1].position);
}

bool World::is_inside(const Hit& hit) const {
    if (hit.object == kSky || is_lamp(hit.object)) return false;
    const Object& object = *objects_[hit.object];
    if (object.sides != Sides::Solid) return false;
    if (object.mesh.triangles.empty()) return dot(hit.normal, hit.direction) > 0;
    // Uses the vertex normals, which point outwards for any winding of the triangle.
    const auto& t = object.mesh.triangles[hit.primitive];
    const auto& p = object.mesh.positions;
    const auto& n = object.mesh.normals;
    const Vec3 flat = cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    const float outwards = dot(flat, n[t[0]] + n[t[1]] + n[t[2]]);
    return dot(flat, hit.direction) * outwards > 0;
}

Matter World::matter(const Hit& hit) const {
    const Object& object = *objects_[hit.object];
    SurfacePoint point{hit.position, {}, hit.u, hit.v, {}, hit.in_mirror};
    if (!is_baked) point.direction = normalised(hit.direction);
    if (object.mesh.triangles.empty()) {
        point.normal = normalised(hit.normal);
    } else {
        const auto& t = object.mesh.triangles[hit.primitive];
        const float w[3] = {1 - hit.u - hit.v, hit.u, hit.v};
        point.u = point.v = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            point.normal += w[k] * object.mesh.normals[t[k]];
            point.u += w[k] * object.mesh.uv[t[k]][0];
            point.v += w[k] * object.mesh.uv[t[k]][1];
        }
    }
    return object.paint(point);
}

Vec3 World::radiance(const Hit& hit) const {
    if (is_lamp(hit.object)) return lamps_[hit.primitive].radiance;
    return is_in_codes_ ? code(light(hit)) : light(hit);
}

Vec3 World::light(const Hit& hit) const {
    if (hit.object == kSky) return sky(hit.direction);
    const Matter m = matter(hit);
    if (!is_baked) return m.emission;
    const Object& object = *objects_[hit.object];
    Vec3 irradiance;
    if (object.mesh.triangles.empty()) {
        irradiance = tube_irradiance(hit.position, normalised(hit.normal));
    } else {
        const auto& t = object.mesh.triangles[hit.primitive];
        irradiance = (1 - hit.u - hit.v) * object.irradiance[t[0]] + hit.u * object.irradiance[t[1]] +
                     hit.v * object.irradiance[t[2]];
    }
    return m.emission + m.albedo * irradiance / kPi;
}

Vec3 World::seen(Vec3 from, Vec3 direction) const {
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    RTCRayHit met{};
    met.ray = ray(from, direction, 1e-4f, std::numeric_limits<float>::infinity());
    do {
        met.ray.tfar = std::numeric_limits<float>::infinity();
        met.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(rays_, &context, &met);
        met.ray.tnear = met.ray.tfar * (1 + 1e-5f);
    } while (is_lamp(met.hit.geomID));
    return radiance({met.hit.geomID,
                     met.hit.primID,
                     met.hit.u,
                     met.hit.v,
                     from + met.ray.tfar * direction,
                     {met.hit.Ng_x, met.hit.Ng_y, met.hit.Ng_z},
                     direction,
                     true});
}

bool World::is_shaded(Vec3 from, Vec3 towards, bool is_distant) const {
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    RTCRay shadow = ray(from, towards, 1e-4f, is_distant ? std::numeric_limits<float>::infinity() : 0.999f);
    rtcOccluded1(rays_, &context, &shadow);
    return shadow.tfar < 0;
}

}  // namespace petzval::scene
