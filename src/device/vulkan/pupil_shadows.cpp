#include "device/vulkan/pupil_shadows.h"

#include "base/parallel.h"
#include "device/vulkan/words.h"
#include "laws/tiles.h"

#include <algorithm>
#include <array>
#include <utility>

namespace petzval::device::vulkan {
namespace {

using engine::Caster;
using engine::CasterRange;
using engine::SeenCaster;
using engine::ShadowCasters;
using engine::ShadowGrid;
using engine::Viewpoint;

// The layouts of shaders/find_casters.comp.
static_assert(sizeof(Caster) == 28 && sizeof(SeenCaster) == 24);
constexpr int kBlock = laws::kGroupSide;  // cells of a pupil that a group covers

}  // namespace

template <typename Visit>
void PupilShadows::for_rows(const Visit& visit) const {
    for (int view = 0; view < ShadowCasters::kViews; ++view)
        for (int by = first_row_; by < end_row_; ++by) visit(plan_.casters->of_row(view, by));
}

std::size_t PupilShadows::caster_bytes() const {
    std::size_t bytes = 0;
    for_rows([&](std::span<const Caster> row) { bytes += row.size_bytes(); });
    return bytes;
}

PupilShadows::PupilShadows(Context& context, const engine::LightsPlan& plan, const ShadowsRule& rule)
    : context_(context), plan_(plan), rule_(rule), end_row_(plan.casters->rows()) {
    sends_all_ = caster_bytes() <= std::min(rule.most_bytes_at_once, context.most_range_bytes());
}

std::size_t PupilShadows::search(std::span<const std::uint32_t> views, Workers& workers) {
    near_.assign(views.size(), {});
    parallel_for(int(views.size()), workers, [&](int i) {
        near_[std::size_t(i)] = engine::near_casters(plan_, plan_.viewpoints[views[std::size_t(i)]]);
    });
    std::size_t fitting = 0;
    for (std::size_t sum = 0; fitting < views.size(); ++fitting) {
        sum += candidates(fitting);
        if (fitting > 0 && sum > context_.at_once(rule_.most_near)) break;
    }
    views_.assign(views.begin(), views.begin() + std::ptrdiff_t(fitting));
    if (sends_all_) return fitting;
    first_row_ = plan_.casters->rows();
    end_row_ = 0;
    for (std::size_t v = 0; v < fitting; ++v)
        for (const CasterRange& range : near_[v]) {
            first_row_ = std::min(first_row_, range.row);
            end_row_ = std::max(end_row_, range.row + 1);
        }
    return fitting;
}

std::uint32_t PupilShadows::candidates(std::size_t view) const {
    std::uint32_t sum = 0;
    for (const CasterRange& range : near_[view]) sum += range.count;
    return sum;
}

std::uint32_t PupilShadows::list(std::vector<std::uint32_t>& words) {
    const engine::OpenSides edges(plan_);
    coming_ = nullptr;
    seen_ = Piece();
    covered_ = Piece();
    push_ = {std::uint32_t(words.size()), 0, 0, edges.left, edges.top, edges.right, edges.bottom};
    cells_ = taps_ = most_taps_ = candidates_ = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
        const ShadowGrid grid(plan_.viewpoints[views_[v]]);
        // An open pupil has no taps. The device counts the casters that are seen.
        const std::uint32_t taps = is_open(v) ? 0 : std::uint32_t(grid.taps),
                            side = taps * std::uint32_t(grid.parts);
        words.insert(words.end(), {candidates_, 0, taps, std::uint32_t(grid.parts), bits_of(grid.scale_px),
                                   cells_, taps_});
        candidates_ += candidates(v);
        cells_ += side * side;
        taps_ += taps * taps;
        most_taps_ = std::max(most_taps_, taps * taps);
    }
    list_searches(words);
    list_blocks(words);
    return push_.views;
}

// The searches and ranges of shaders/find_casters.comp.
void PupilShadows::list_searches(std::vector<std::uint32_t>& words) {
    std::vector<std::uint32_t> first{0};  // of each row
    for_rows([&](std::span<const Caster> row) { first.push_back(first.back() + std::uint32_t(row.size())); });
    const auto row_of = [this](const CasterRange& range) {
        return std::size_t(range.view * (end_row_ - first_row_) + range.row - first_row_);
    };
    std::vector<std::uint32_t> ranges;
    push_.searches = std::uint32_t(words.size());
    for (std::size_t v = 0; v < views_.size(); ++v) {
        const Viewpoint& view = plan_.viewpoints[views_[v]];
        words.insert(words.end(),
                     {std::uint32_t(ranges.size() / 2), std::uint32_t(near_[v].size()), candidates(v),
                      bits_of(view.x), bits_of(view.y), bits_of(view.coc_px), std::uint32_t(view.size),
                      std::uint32_t(view.is_shown), bits_of(engine::pupil_end(plan_, view))});
        std::uint32_t before = 0;
        for (const CasterRange& range : near_[v]) {
            ranges.insert(ranges.end(), {first[row_of(range)] + range.first, before});
            before += range.count;
        }
    }
    push_.ranges = std::uint32_t(words.size());
    words.insert(words.end(), ranges.begin(), ranges.end());
}

// The parts of the pupils that shaders/cover_pupil.comp covers, a group each.
void PupilShadows::list_blocks(std::vector<std::uint32_t>& words) {
    first_block_ = std::uint32_t(words.size());
    for (std::size_t v = 0; v < views_.size(); ++v) {
        if (is_open(v)) continue;
        const ShadowGrid grid(plan_.viewpoints[views_[v]]);
        const int side = grid.taps * grid.parts;
        for (int y = 0; y < side; y += kBlock)
            for (int x = 0; x < side; x += kBlock)
                words.insert(words.end(),
                             {std::uint32_t(v), std::uint32_t(x / kBlock) | std::uint32_t(y / kBlock) << 16});
    }
    blocks_ = (std::uint32_t(words.size()) - first_block_) / 2;
}

Piece PupilShadows::visible(Recording& recording, const Piece& words) {
    Heap& heap = context_.heap();
    Piece visible = heap.allocate(Kind::OnDevice, taps_ * sizeof(float));
    if (candidates_ == 0) return visible;
    coming_ = casters(recording);
    seen_ = heap.allocate(Kind::OnDevice, candidates_ * sizeof(SeenCaster));
    covered_ = heap.allocate(Kind::OnDevice, cells_ * sizeof(float));
    recording.pass("find casters", context_.program(Shader::FindCasters), {&words, &coming_->casters, &seen_},
                   push_, {std::uint32_t(views_.size())});
    cover(recording, words);
    recording.pass("open pupils", context_.program(Shader::OpenPupil), {&words, &covered_, &visible},
                   push_.views, {(most_taps_ + 255) / 256, std::uint32_t(views_.size())});
    return visible;
}

void PupilShadows::finish() {
    seen_ = Piece();
    covered_ = Piece();
    if (coming_) casters_ = std::move(coming_);
    if (casters_ && sends_all_ && plan_.kept) *plan_.kept = casters_;
}

void PupilShadows::cover(Recording& recording, const Piece& words) {
    constexpr std::uint32_t kMostGroups = 65535;
    for (std::uint32_t done = 0; done < blocks_; done += kMostGroups) {
        const std::array<std::uint32_t, 2> push{push_.views, first_block_ + 2 * done};
        recording.pass("cover pupils", context_.program(Shader::CoverPupil), {&words, &seen_, &covered_},
                       push, {std::min(kMostGroups, blocks_ - done)});
    }
}

std::shared_ptr<const CastersOnDevice> PupilShadows::casters(Recording& recording) const {
    if (casters_ && sends_all_) return casters_;
    if (sends_all_ && plan_.kept)
        if (auto kept = std::dynamic_pointer_cast<const CastersOnDevice>(*plan_.kept)) return kept;
    auto made = std::make_shared<CastersOnDevice>();
    std::vector<std::span<const std::byte>> rows;
    for_rows([&](std::span<const Caster> row) { rows.push_back(std::as_bytes(row)); });
    made->casters = recording.uploaded(rows);
    return made;
}

}  // namespace petzval::device::vulkan
