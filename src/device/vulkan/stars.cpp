#include "device/vulkan/stars.h"

#include "device/vulkan/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using glare::Filter;
using glare::GlarePlan;
using glare::StarTap;
using glare::Streak;

Piece room(Context& context, std::size_t bytes) { return context.heap().allocate(Kind::OnDevice, bytes); }

// Highlights on cells of factor x factor pixels.
void take_highlights(Context& context, Recording& recording, const Piece& picture, Size size, Size cells,
                     std::uint32_t factor, float threshold, const Piece& to) {
    const std::array push{size.width, size.height, cells.width, cells.height, factor, bits_of(threshold)};
    recording.pass("take highlights", context.program(Shader::StarReduce), {&picture, &to}, push,
                   invocations(cells.pixels()));
}

// Streaks, those of one reduction together.
class Streaks {
public:
    Streaks(Context& context, const GlarePlan& plan, const Piece& picture, Size size)
        : context_(context), plan_(plan), picture_(picture), size_(size) {}

    Piece drawn() {
        Piece star = room(context_, size_.bytes());
        std::uint32_t adds = 0;
        for (std::size_t i = 0; i < plan_.streaks.size(); adds = 1) {
            const auto factor = std::uint32_t(plan_.streaks[i].reduction);
            cells_ = {(size_.width + factor - 1) / factor, (size_.height + factor - 1) / factor};
            light_ = room(context_, cells_.bytes()), sum_ = room(context_, cells_.bytes());
            for (Piece& piece : between_) piece = room(context_, cells_.bytes());
            reduce(factor);
            std::uint32_t adds_streak = 0;
            for (; i < plan_.streaks.size() && std::uint32_t(plan_.streaks[i].reduction) == factor; ++i)
                draw(plan_.streaks[i], std::exchange(adds_streak, 1));
            Recording recording(context_);
            const std::array push{size_.width, size_.height, cells_.width, cells_.height, factor, adds};
            recording.pass("enlarge star", context_.program(Shader::StarEnlarge), {&sum_, &star}, push,
                           invocations(size_.pixels()));
            recording.run();
        }
        return star;
    }

private:
    void reduce(std::uint32_t factor) {
        Recording recording(context_);
        take_highlights(context_, recording, picture_, size_, cells_, factor, plan_.threshold, light_);
        recording.run();
    }

    void draw(const Streak& streak, std::uint32_t adds) {
        Recording recording(context_);
        std::vector<std::uint32_t> words, ends;
        for (const auto& taps : streak.passes) {
            for (const StarTap& tap : taps)
                words.insert(words.end(),
                             {std::uint32_t(tap.dx), std::uint32_t(tap.dy), bits_of(tap.weight.r),
                              bits_of(tap.weight.g), bits_of(tap.weight.b)});
            ends.push_back(std::uint32_t(words.size()));
        }
        const Piece taps = recording.uploaded(std::span<const std::uint32_t>(words));
        const Piece* from = &light_;
        for (std::size_t pass = 0; pass < ends.size(); ++pass) {
            const bool is_last = pass + 1 == ends.size();
            const Piece& to = is_last ? sum_ : between_[pass % 2];
            const std::array push{cells_.width,
                                  cells_.height,
                                  pass > 0 ? ends[pass - 1] : 0,
                                  ends[pass],
                                  bits_of(is_last ? 1 / streak.parts : 1),
                                  is_last ? adds : 0};
            recording.pass("streak", context_.program(Shader::StarStreak), {&taps, from, &to}, push,
                           invocations(cells_.pixels()));
            from = &to;
        }
        recording.run();
    }

    Context& context_;
    const GlarePlan& plan_;
    const Piece& picture_;
    const Size size_;
    Size cells_;
    Piece light_, sum_;
    std::array<Piece, 2> between_;
};

struct Push {
    Size size;
    std::uint32_t side = 0, reach = 0;
    std::int32_t left = 0, top = 0;
    std::uint32_t channels = 0;
    float threshold = 0;
    std::uint32_t adds = 0, half_length = 0, stride = 0, across = 0;
    float sign = 0;
};
static_assert(sizeof(Push) == 52, "as shaders/star.glsl has it");

// The final star: tiles of the picture convolved with its kernel, two channels at a time.
class Convolution {
public:
    Convolution(Context& context, const GlarePlan& plan, const Piece& picture, Size size)
        : context_(context), filter_(*plan.filter), picture_(picture) {
        push_.size = size, push_.threshold = plan.threshold;
        push_.side = std::uint32_t(filter_.size), push_.reach = std::uint32_t(filter_.reach);
    }

    Piece drawn() {
        upload();
        star_ = room(context_, push_.size.bytes());
        const int tile = filter_.size - 2 * filter_.reach;
        for (push_.top = 0; push_.top < int(push_.size.height); push_.top += tile)
            for (push_.left = 0; push_.left < int(push_.size.width); push_.left += tile)
                for (push_.channels = 0; push_.channels < 2; ++push_.channels) {
                    add_tile();
                    push_.adds = 1;
                }
        return std::move(star_);
    }

private:
    std::size_t points() const { return std::size_t(push_.side) * push_.side; }

    void upload() {
        Recording recording(context_);
        std::vector<float> turns;
        for (std::uint32_t k = 0; k < push_.side / 2; ++k) {
            const double angle = 2 * std::numbers::pi * k / push_.side;
            turns.push_back(float(std::cos(angle))), turns.push_back(float(std::sin(angle)));
        }
        turns_ = recording.uploaded(std::span<const float>(turns));
        red_ = recording.uploaded(std::span(filter_.r)), green_ = recording.uploaded(std::span(filter_.g));
        blue_ = recording.uploaded(std::span(filter_.b));
        for (Piece& field : fields_) field = room(context_, points() * 2 * sizeof(float));
        recording.run();
    }

    void add_tile() {
        Recording recording(context_);
        current_ = 0;
        recording.pass("take highlights", context_.program(Shader::StarLoad), {&picture_, fields_.data()},
                       push_, invocations(points()));
        transform(recording, -1);
        const bool is_pair = push_.channels == 0;
        recording.pass("filter star", context_.program(Shader::StarFilter),
                       {is_pair ? &red_ : &blue_, is_pair ? &green_ : &blue_, &fields_[current_],
                        &fields_[1 - current_]},
                       push_, invocations(points()));
        current_ = 1 - current_;
        transform(recording, 1);
        recording.pass("add star", context_.program(Shader::StarAdd), {&fields_[current_], &star_}, push_,
                       invocations(push_.size.pixels()));
        recording.run();
    }

    void transform(Recording& recording, float sign) {
        const std::uint32_t side = push_.side;
        Push push = push_;
        push.sign = sign;
        for (const auto& [stride, across] : {std::pair(1u, side), {side, 1u}})
            for (push.half_length = 1; push.half_length < side; push.half_length *= 2) {
                push.stride = stride, push.across = across;
                recording.pass("transform star", context_.program(Shader::StarTransform),
                               {&turns_, &fields_[current_], &fields_[1 - current_]}, push,
                               invocations(points() / 2));
                current_ = 1 - current_;
            }
    }

    Context& context_;
    const Filter& filter_;
    const Piece& picture_;
    Push push_;
    Piece turns_, red_, green_, blue_, star_;
    std::array<Piece, 2> fields_;
    std::size_t current_ = 0;  // of these: what was written last
};

}  // namespace

Piece drawn_star(Context& context, const GlarePlan& plan, const Piece& picture, Size size) {
    return plan.filter ? Convolution(context, plan, picture, size).drawn()
                       : Streaks(context, plan, picture, size).drawn();
}

Picture highlights_at_home(Context& context, const Piece& picture, Size size, float threshold) {
    Recording recording(context);
    const Piece light = room(context, size.bytes());
    take_highlights(context, recording, picture, size, size, 1, threshold, light);
    const auto* from = reinterpret_cast<const Rgba*>(recording.downloaded(light, size.bytes()));
    recording.run();
    Picture bright = Picture::uninitialised(int(size.width), int(size.height));
    std::copy_n(from, size.pixels(), bright.pixels());
    return bright;
}

std::size_t largest_star_bytes(const GlarePlan& plan) {
    if (!plan.filter) return 0;
    return 2 * sizeof(float) * std::size_t(plan.filter->size) * std::size_t(plan.filter->size);
}

}  // namespace petzval::device::vulkan
