#include "petzval/session.h"

#include "engine/gather/realtime_plan.h"
#include "kernel/lenses/make_lens.h"

namespace petzval {

Result<RealtimeLensBuffer> realtime_lens_buffer(const Lens& lens, const Camera& camera, int width_px,
                                                int height_px, Quality quality) {
    const auto mounted = kernel::make_lens(lens, {camera, width_px, height_px});
    if (!mounted) return mounted.error();
    const engine::RealtimeLens made = engine::realtime_lens_of_host(**mounted, width_px, height_px, quality);
    RealtimeLensBuffer buffer;
    buffer.values.reserve(4 * made.fours.size());
    for (const Rgba& four : made.fours)
        for (const float value : {four.r, four.g, four.b, four.a}) buffer.values.push_back(value);
    buffer.taps = made.taps();
    buffer.columns = int(made.fours[0].b);
    buffer.rows = int(made.fours[0].a);
    return buffer;
}

Result<std::size_t> realtime_lens_buffer_bytes(const Lens& lens, const Camera& camera, int width_px,
                                               int height_px, Quality quality) {
    const auto mounted = kernel::make_lens(lens, {camera, width_px, height_px});
    if (!mounted) return mounted.error();
    const std::uint32_t zones = engine::realtime_zones(**mounted, width_px, height_px).count();
    return engine::RealtimeLens::count(engine::realtime_taps(quality), zones) * sizeof(Rgba);
}

}  // namespace petzval
