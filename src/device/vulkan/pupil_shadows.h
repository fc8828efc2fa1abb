// Shadows in the pupils of viewpoints, found on the device: what device/cpu/lights/pupil_shadow.h does.
#pragma once

#include "device/vulkan/driver/recording.h"
#include "engine/lights/shadow_plan.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace petzval::device::vulkan {

// Casters of a plan: rows of blocks one after the other, those of a finer view before those of a coarser.
struct CastersOnDevice final : Kept {
    Piece casters;
};

struct ShadowsRule {
    std::size_t most_near = std::size_t(4) << 20;  // casters near all viewpoints of a batch together
    // A plan's casters are sent once if they take no more bytes, and otherwise the rows that a batch needs.
    std::size_t most_bytes_at_once = std::size_t(-1);
};

// The host lists the occluders near each viewpoint as ranges of all; the device finds which of them the
// viewpoint sees, and how much of the pupil they cover.
class PupilShadows {
public:
    PupilShadows(Context& context, const engine::LightsPlan& plan, const ShadowsRule& rule);

    // Lists what is near these viewpoints of the plan. Returns how many of them have few enough casters near
    // them, at least one; the others are left out.
    std::size_t search(std::span<const std::uint32_t> views, Workers& workers);
    // True if nothing is near the viewpoint in that place of the list.
    bool is_open(std::size_t view) const { return near_[view].empty(); }
    // Appends the viewpoints for shaders/cover_pupil.comp to a batch's words, and more for other programs.
    // Returns where they begin.
    std::uint32_t list(std::vector<std::uint32_t>& words);
    // Records the passes that find how much each tap of each viewpoint sees.
    Piece visible(Recording& recording, const Piece& words);
    // To be called when the recording has run: the casters are on the device, the lists of the seen are
    // released.
    void finish();

private:
    // visit(a row of blocks), for those that are on the device, in order.
    template <typename Visit>
    void for_rows(const Visit& visit) const;
    std::size_t caster_bytes() const;
    std::uint32_t candidates(std::size_t view) const;
    std::shared_ptr<const CastersOnDevice> casters(Recording& recording) const;
    void list_searches(std::vector<std::uint32_t>& words);
    void list_blocks(std::vector<std::uint32_t>& words);
    void cover(Recording& recording, const Piece& words);

    Context& context_;
    const engine::LightsPlan& plan_;
    const ShadowsRule rule_;
    bool sends_all_ = true;
    int first_row_ = 0, end_row_ = 0;                          // of blocks that are on the device
    std::shared_ptr<const CastersOnDevice> casters_, coming_;  // `coming_`: once the recording has run
    // Viewpoints of a batch, and the ranges of casters near each.
    std::vector<std::uint32_t> views_;
    std::vector<std::vector<engine::CasterRange>> near_;
    struct Push {
        std::uint32_t views = 0, searches = 0, ranges = 0;
        float left = 0, top = 0, right = 0, bottom = 0;
    } push_;
    std::uint32_t first_block_ = 0, blocks_ = 0, cells_ = 0, taps_ = 0, most_taps_ = 0, candidates_ = 0;
    Piece seen_, covered_;
};

}  // namespace petzval::device::vulkan
