// Positions of visible surfaces a frame earlier and later.
#include "base/parallel.h"
#include "scene/tracing.h"

#include <limits>

namespace petzval::scene {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Motion of the surface at the pixel's centre; the sky turns with the camera and does not move.
PixelMove move_of(const Pass& pass, const World& other, const World::Hit& hit, float x, float y) {
    const auto moved = pass.world.moved_in(other, hit);
    if (!moved) return {kUnknown, kUnknown};
    const bool is_sky = hit.object == World::kSky;
    const Vec3 p =
        other.view.from_world(is_sky ? other.view.position + hit.direction : hit.position + *moved);
    if (!(p.z > 0)) return {kUnknown, kUnknown};
    return {pass.lens.image_x(p) - x, pass.lens.image_y(p) - y};
}

}  // namespace

Image<PixelMove> render_motion(const Pass& pass, const World& other) {
    const int width = pass.area.width(), height = pass.area.height();
    auto moves = Image<PixelMove>::uninitialised(width, height);
    parallel_for(height, pass.workers, [&](int row) {
        const float y = float(pass.area.y0 + row) + 0.5f;
        for (int first = 0; first < width; first += kPacket) {
            Packet packet(pass.world);
            const int lanes = std::min(kPacket, width - first);
            const auto x = [&](int lane) { return float(pass.area.x0 + first + lane) + 0.5f; };
            for (int lane = 0; lane < lanes; ++lane) packet.set(lane, pass.lens.through(x(lane), y, {}));
            packet.intersect();
            for (int lane = 0; lane < lanes; ++lane)
                moves(first + lane, row) = move_of(pass, other, packet.hit(lane), x(lane), y);
        }
    });
    return moves;
}

}  // namespace petzval::scene
