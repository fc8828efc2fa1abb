// A scene ready to be looked at: shapes, what they are painted with, the light that falls on them.
//
// In most of them everything is matt or glows by itself, so a point has the same colour from everywhere: a
// pinhole picture with depth says all there is to say about what is visible, and the truth differs from it by
// the lens alone. Light is baked once into the vertices (soft shadows, sky, one bounce); tubes are lit
// without shadows. Others are shaded as shaders do (shading.h): built at once, with highlights and mirrors.
#pragma once

#include "petzval/result.h"
#include "petzval/workers.h"

#include "scene/shapes.h"
#include "scene/vec3.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <embree3/rtcore.h>

namespace petzval::scene {

struct SurfacePoint {
    Vec3 position, normal;
    float u = 0, v = 0;
    Vec3 direction = {};     // of the ray that sees it, unit length
    bool in_mirror = false;  // seen by World::seen()
};

struct Matter {
    Vec3 albedo, emission;
};
using Paint = std::function<Matter(const SurfacePoint&)>;

// True if a mesh has matter at its texture coordinates; holes are transparent and cast no shadow.
using Cutout = std::function<bool(float u, float v)>;

enum class Sides {
    Solid,  // closed and opaque: its inside is never seen
    Sheet,  // seen and lit from the side of its normal
    Leaf,   // thin: lit alike from both sides
};

// A light that casts soft shadows but is not seen itself. A distant one has the direction towards it as
// `position`, its irradiance as `power` and the tangent of its angular radius as `radius`; a near one is a
// sphere of `radius` metres and `power` is its radiant intensity.
struct Light {
    Vec3 position, power;
    float radius = 0.1f;
    bool distant = false;
    bool lights_tubes = true;  // tubes cast shadows but receive none: false where they stand in the shade
};

// Cosine-free share of a light at a point: where it comes from, and the irradiance of a surface facing it.
struct Arrival {
    Vec3 towards;  // not of unit length for a near light: ends at the light
    Vec3 facing;
};
Arrival arrival(const Light& light, Vec3 position);

// A small disc parallel to the sensor that glows; tracked one by one, so that its image through the lens can
// be integrated without noise however bright it is.
struct Lamp {
    Vec3 centre;
    float radius_m = 0;
    Vec3 radiance;
};

struct Viewpoint {
    Vec3 position, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
    static Viewpoint looking(Vec3 from, Vec3 at);
    bool operator==(const Viewpoint& o) const {
        return length(position - o.position) == 0 && length(right - o.right) == 0 && length(up - o.up) == 0 &&
               length(forward - o.forward) == 0;
    }
    Vec3 to_world(Vec3 v) const { return v.x * right + v.y * up + v.z * forward; }
    Vec3 from_world(Vec3 p) const {
        return {dot(p - position, right), dot(p - position, up), dot(p - position, forward)};
    }
};

class World {
public:
    // Embree builds its tree with oneTBB's threads, or with the one that calls.
    explicit World(bool one_thread = false);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    // Building, before commit().
    Viewpoint view;
    std::function<Vec3(Vec3 direction)> sky = [](Vec3) { return Vec3{}; };  // radiance towards a direction
    Vec3 ambient_above, ambient_below;  // irradiance that tubes get besides the lights
    // Maximum of one ray in baking: a bright spot that few rays find would bake to blotches. Where it matters
    // (a window), a Light represents it.
    float brightest_bounce = 20;
    // False: paints say all light as emission, by SurfacePoint::direction if they like; nothing is baked.
    bool is_baked = true;
    std::vector<Light> lights;
    void add(Mesh mesh, Paint paint, Sides sides, Cutout cutout = nullptr);
    void add(Tubes tubes, Paint paint);
    void add_lamp(Vec3 centre, float radius_m, Vec3 radiance);
    // Shows the scene in display codes (sRGB), as programs did that took codes for light: their textures
    // and light maps were painted until a surface had the code that it should have on the display. Radiance
    // then is the code of the light of each point, and lenses and pixels add codes. Requires: is_baked; once,
    // before commit().
    void light_in_codes();

    // Builds the ray tracing structure and bakes light. Errors: OutOfMemory.
    Status commit(Workers& workers);
    // Changes the viewpoint, before or after commit(): lamps face the viewer. Errors: as commit().
    Status look_from(const Viewpoint& from);

    // Looking, after commit(); thread-safe.
    static constexpr std::uint32_t kSky = RTC_INVALID_GEOMETRY_ID;
    struct Hit {
        std::uint32_t object = kSky, primitive = 0;
        float u = 0, v = 0;
        Vec3 position, normal, direction;  // normal of the geometry, not of unit length; direction of the ray
        bool in_mirror = false;
    };
    RTCScene rays() const { return rays_; }
    const std::vector<Lamp>& lamps() const { return lamps_; }
    bool is_lamp(std::uint32_t object) const { return object == lamp_object_ && object != kSky; }
    // Position of that surface point in another world of the same objects; empty if that world has other
    // objects.
    std::optional<Vec3> moved_in(const World& other, const Hit& hit) const;
    // A surface that can never be seen from this side.
    bool is_inside(const Hit& hit) const;
    Vec3 radiance(const Hit& hit) const;
    // Reflection of a mirror at `from` in that direction, without lamps; and occlusion towards a light, which
    // is infinitely far if `is_distant`.
    Vec3 seen(Vec3 from, Vec3 direction) const;
    bool is_shaded(Vec3 from, Vec3 towards, bool is_distant) const;

private:
    struct Object;
    Vec3 light(const Hit& hit) const;  // hit: no lamp
    static void open_holes(const RTCFilterFunctionNArguments* hits);
    void attach_lamps();
    Status commit_rays();
    // Throw std::bad_alloc: Embree fails at nothing else here.
    RTCGeometry new_geometry(RTCGeometryType type) const;
    unsigned attach(
        RTCGeometry geometry) const;  // its number in the scene; the geometry is the scene's from here on
    void bake(Workers& workers);
    template <typename Irradiance>
    void for_each_vertex(Workers& workers, const Irradiance& irradiance);
    Vec3 direct_irradiance(Vec3 position, Vec3 normal, std::uint32_t seed) const;
    Vec3 indirect_irradiance(Vec3 position, Vec3 normal, std::uint32_t seed) const;
    Vec3 tube_irradiance(Vec3 position, Vec3 normal) const;
    Matter matter(const Hit& hit) const;

    RTCDevice device_ = nullptr;
    RTCScene rays_ = nullptr;
    std::vector<std::unique_ptr<Object>> objects_;  // by Embree geometry id
    std::vector<Lamp> lamps_;
    std::uint32_t lamp_object_ = kSky;
    bool is_in_codes_ = false;
    Vec3* lamp_normals_ = nullptr;  // Embree's, after commit()
};

}  // namespace petzval::scene
