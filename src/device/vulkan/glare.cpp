#include "device/vulkan/glare.h"

#include "device/failure.h"
#include "device/vulkan/stars.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using glare::BloomPlan;
using glare::GlarePlan;

struct BlurPush {
    Size size;
    std::uint32_t down = 0, first = 0, radius = 0;
    float share = 1;
    std::uint32_t adds = 0;
};

struct LightPush {
    Size size, padded;
    float threshold = 0;
};

struct AddPush {
    Size size;
    std::uint32_t padded_width = 0;
    float of_all = 0, of_highlights = 0, threshold = 0;
    float of_bloom_light = 0, bloom_threshold = 0;
    float bloom = 0, star = 0, ghosts = 0, veil = 0;
};

Piece uploaded(View<const Rgba> picture, Recording& recording) {
    std::vector<Rgba> pixels;
    pixels.reserve(std::size_t(picture.width()) * std::size_t(picture.height()));
    for (int y = 0; y < picture.height(); ++y)
        pixels.insert(pixels.end(), picture.row(y), picture.row(y) + picture.width());
    return recording.uploaded(std::span<const Rgba>(pixels));
}

class Glare {
public:
    Glare(Context& context, const GlarePlan& plan, Size size)
        : context_(context), plan_(plan), recording_(context), size_(size), none_(room(1)) {}

    // In place.
    void add_to(const Piece& pixels, const Piece& star) {
        if (plan_.bloom > 0) make_bloom(pixels);
        if (plan_.ghosts > 0) ghosts_ = uploaded(plan_.ghost_light, recording_);
        if (plan_.veil > 0) sum_up(pixels);
        const auto or_none = [&](const Piece& piece) { return piece.size() > 0 ? &piece : &none_; };
        const AddPush push{size_,
                           padded_.width,
                           plan_.of_all,
                           plan_.of_highlights,
                           plan_.threshold,
                           plan_.of_bloom_light,
                           plan_.bloom_threshold,
                           plan_.bloom,
                           plan_.star,
                           plan_.ghosts,
                           plan_.veil / float(size_.pixels())};
        recording_.pass("add glare", context_.program(Shader::GlareAdd),
                        {&pixels, glow_ ? glow_ : &none_, or_none(star), or_none(ghosts_), or_none(sums_)},
                        push, invocations(size_.pixels()));
        recording_.run();
    }

private:
    Piece room(std::size_t pixels) { return context_.heap().allocate(Kind::OnDevice, pixels * sizeof(Rgba)); }
    // Halves light level by level, then sums blurred light from the coarsest level down.
    void make_bloom(const Piece& picture) {
        const BloomPlan& plan = plan_.bloom_layers;
        padded_ = {std::uint32_t(plan.padded(int(size_.width))),
                   std::uint32_t(plan.padded(int(size_.height)))};
        make_levels(picture);
        weights_ = recording_.uploaded(std::span<const float>(weights()));
        across_ = room(padded_.pixels());
        for (int level = plan.coarsest; level >= 0; --level) {
            const Size size = sizes_[std::size_t(level)];
            const Piece& sum = sums_by_level_[std::size_t(level)];
            std::uint32_t adds = 0;
            for (std::size_t k = 0; k < plan.blurs.size(); ++k)
                if (plan.blurs[k].level == level) blur(k, levels_[std::size_t(level)], sum, size, adds++);
            if (level == plan.coarsest) continue;
            const std::array<std::uint32_t, 3> push{size.width, size.height, std::min(adds, 1u)};
            recording_.pass("enlarge bloom", context_.program(Shader::GlareEnlarge),
                            {&sums_by_level_[std::size_t(level) + 1], &sum}, push,
                            invocations(size.pixels()));
        }
        glow_ = &sums_by_level_.front();
    }

    void make_levels(const Piece& picture) {
        for (Size size = padded_; int(levels_.size()) <= plan_.bloom_layers.coarsest; size = size.halved()) {
            sizes_.push_back(size);
            levels_.push_back(room(size.pixels()));
            sums_by_level_.push_back(room(size.pixels()));
        }
        const LightPush push{size_, padded_, plan_.bloom_threshold};
        recording_.pass("take light", context_.program(Shader::GlareLight), {&picture, &levels_.front()},
                        push, invocations(padded_.pixels()));
        for (std::size_t l = 1; l < levels_.size(); ++l)
            recording_.pass("halve light", context_.program(Shader::GlareHalve),
                            {&levels_[l - 1], &levels_[l]}, sizes_[l], invocations(sizes_[l].pixels()));
    }

    // Weights of all blurs, horizontal and vertical.
    std::vector<float> weights() {
        std::vector<float> all;
        for (const BloomPlan::Blur& blur : plan_.bloom_layers.blurs)
            for (const auto* axis : {&blur.across, &blur.down}) {
                first_weights_.push_back(std::uint32_t(all.size()));
                all.insert(all.end(), axis->begin(), axis->end());
            }
        return all;
    }

    void blur(std::size_t number, const Piece& light, const Piece& sum, Size size, std::uint32_t adds) {
        const BloomPlan::Blur& blur = plan_.bloom_layers.blurs[number];
        const Program& program = context_.program(Shader::GlareBlur);
        const auto radius = [](const std::vector<float>& w) { return std::uint32_t(w.size() / 2); };
        recording_.pass("blur bloom", program, {&weights_, &light, &across_},
                        BlurPush{size, 0, first_weights_[2 * number], radius(blur.across), 1, 0},
                        invocations(size.pixels()));
        recording_.pass("blur bloom", program, {&weights_, &across_, &sum},
                        BlurPush{size, 1, first_weights_[2 * number + 1], radius(blur.down),
                                 plan_.bloom_layers.share(), std::min(adds, 1u)},
                        invocations(size.pixels()));
    }

    void sum_up(const Piece& picture) {
        constexpr std::uint32_t kSlices = 256;
        slices_ = room(kSlices), sums_ = room(1);
        const Program& program = context_.program(Shader::GlareSum);
        recording_.pass("sum light", program, {&picture, &slices_}, std::uint32_t(size_.pixels()), {kSlices});
        recording_.pass("sum light", program, {&slices_, &sums_}, kSlices, {1});
    }

    Context& context_;
    const GlarePlan& plan_;
    Recording recording_;
    const Size size_;
    const Piece none_;
    Size padded_;
    std::vector<Size> sizes_;  // by level, as the next two
    std::vector<Piece> levels_, sums_by_level_;
    std::vector<std::uint32_t> first_weights_;
    Piece weights_, across_, ghosts_, slices_, sums_;
    const Piece* glow_ = nullptr;
};

}  // namespace

bool add_planned_glare(Context& context, const GlarePlan& plan, DeviceCanvas& picture) {
    const auto padded = [&](int pixels) {
        return std::size_t(plan.bloom > 0 ? plan.bloom_layers.padded(pixels) : pixels);
    };
    const std::size_t largest =
        std::max(padded(picture.width()) * padded(picture.height()) * sizeof(Rgba), largest_star_bytes(plan));
    if (largest > context.most_range_bytes()) return false;
    const Size size{std::uint32_t(picture.width()), std::uint32_t(picture.height())};
    try {
        const Piece* const pixels = picture.sent();
        if (!pixels) return false;
        Piece star;
        if (plan.star > 0) star = drawn_star(context, plan, *pixels, size);
        Glare(context, plan, size).add_to(*pixels, star);
    } catch (const Failed& failed) {  // the last pass alone changes the picture
        if (failed.error.code != ErrorCode::OutOfMemory) throw;
        context.say(context.name() + " has no memory left for the glare of a whole frame; the CPU makes it");
        return false;
    }
    return true;
}

}  // namespace petzval::device::vulkan
