#include "petzval/session.h"

#include "engine/gather/realtime_plan.h"
#include "kernel/lenses/make_lens.h"

#include <cstring>

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

Status check_lens_buffer(std::span<const std::byte> buffer) {
    using engine::RealtimeLens;
    const auto refused = [](const std::string& what) {
        return Error{ErrorCode::InvalidFile,
                     "the lens buffer " + what + "; write it with the petzval that made the programs"};
    };
    const std::string mark(RealtimeLens::kMark.begin(), RealtimeLens::kMark.end());
    constexpr std::size_t kMarkByte = RealtimeLens::kMarkByte;
    if (buffer.size() < kMarkByte + mark.size() ||
        std::memcmp(buffer.data() + kMarkByte, mark.data(), mark.size()) != 0)
        return refused("has no mark " + mark + " at byte " + std::to_string(kMarkByte));
    Rgba head;
    std::memcpy(&head, buffer.data(), sizeof head);
    const auto is_count = [](float value) { return value >= 1 && value <= RealtimeLens::kMostTaps; };
    if (!is_count(head.r) || !is_count(head.b) || !is_count(head.a))
        return refused("names no numbers of taps and places");
    const std::size_t whole = sizeof head * RealtimeLens::count(int(head.r), std::uint32_t(head.b * head.a));
    if (buffer.size() != whole)
        return refused("has " + std::to_string(buffer.size()) + " bytes instead of " + std::to_string(whole));
    return Done{};
}

}  // namespace petzval
