#include "darkroom.h"

#include "petzval/views.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace petzval::view {
namespace {

// The wanted part, `reduce` by `reduce` pixels averaged.
template <typename T>
Image<T> reduced(const Image<T>& from, const Rect& part, int by) {
    Image<T> small((part.width() + by - 1) / by, (part.height() + by - 1) / by);
    for (int y = 0; y < small.height(); ++y)
        for (int x = 0; x < small.width(); ++x) {
            const Rect block =
                Rect{part.x0 + x * by, part.y0 + y * by, part.x0 + (x + 1) * by, part.y0 + (y + 1) * by}
                    .intersected(part);
            T sum{};
            for (int v = block.y0; v < block.y1; ++v)
                for (int u = block.x0; u < block.x1; ++u) sum += from(u, v);
            small(x, y) = sum * (1.0f / float(block.width() * block.height()));
        }
    return small;
}

// Takes one value per block of a plane: a mean of depths across an edge lies on neither side.
Plane picked(const Plane& from, const Rect& part, int by) {
    Plane small((part.width() + by - 1) / by, (part.height() + by - 1) / by);
    for (int y = 0; y < small.height(); ++y)
        for (int x = 0; x < small.width(); ++x) small(x, y) = from(part.x0 + x * by, part.y0 + y * by);
    return small;
}

void isolate(Picture& picture, Channel channel) {
    if (channel == Channel::Colour) return;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        Rgba& p = picture.pixels()[i];
        const float value = channel == Channel::Red     ? p.r
                            : channel == Channel::Green ? p.g
                            : channel == Channel::Blue  ? p.b
                                                        : p.a;
        p = {value, value, value, 1};
    }
}

std::uint8_t code_of(double display_linear) {
    return std::uint8_t(std::lround(255 * std::clamp(srgb_encode(display_linear), 0.0, 1.0)));
}

void put(std::uint8_t* to, const Rgba& colour, double alpha = 1) {
    to[0] = code_of(double(colour.r)), to[1] = code_of(double(colour.g)), to[2] = code_of(double(colour.b));
    to[3] = std::uint8_t(std::lround(255 * alpha));
}

struct Extremes {
    float least = 0, most = 0;
};
Extremes extremes_of(const Plane& plane, bool positive_alone) {
    Extremes found{1e30f, -1e30f};
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const float value = plane.pixels()[i];
        if (!std::isfinite(value) || (positive_alone && value <= 0)) continue;
        found = {std::min(found.least, value), std::max(found.most, value)};
    }
    return found.least > found.most ? Extremes{0, 0} : found;
}

void put_radius(std::uint8_t* to, float radius, const Extremes& all, const Negative& of) {
    const float deepest =
        std::max({radius < 0 ? -all.least : all.most, float(of.permissible_radius_px), 1e-6f});
    const float share = std::isnan(radius) ? 0 : std::min(1.0f, std::abs(radius) / deepest);
    const Rgba& tint = radius < 0 ? kNearColour : kFarColour;
    if (of.numbers == Numbers::Radii) return put(to, share * tint);
    const bool sharp = std::abs(radius) < float(of.permissible_radius_px);
    put(to, sharp ? Rgba{1, 1, 1, 1} : tint, sharp ? 0.35 : 0.25 + 0.4 * std::sqrt(double(share)));
}

void put_depth(std::uint8_t* to, float depth, const Extremes& all) {
    const bool miss = !(depth > 0) || std::isinf(depth);
    const float near_dpt = 1 / std::max(all.least, 1e-6f), far_dpt = 1 / std::max(all.most, 1e-6f);
    const float share =
        miss ? 0 : 0.05f + 0.95f * (1 / depth - far_dpt) / std::max(near_dpt - far_dpt, 1e-9f);
    put(to, share * Rgba{1, 1, 1, 1});
}

void print_numbers(const Negative& of, const Rect& part, Print& print) {
    const Plane small = picked(*of.plane, part, of.reduce);
    const Extremes all = extremes_of(*of.plane, of.numbers == Numbers::Depth);
    print.width = small.width(), print.height = small.height();
    print.rgba.resize(4 * small.size());
    for (std::size_t i = 0; i < small.size(); ++i) {
        std::uint8_t* to = print.rgba.data() + 4 * i;
        if (of.numbers == Numbers::Depth)
            put_depth(to, small.pixels()[i], all);
        else
            put_radius(to, small.pixels()[i], all, of);
    }
}

void paint_numbers(const Negative& of, Print& print) {
    for (const Panel& panel : *of.panels) {
        if (!panel.is_numbers) continue;
        for (int y = 0; y < print.height; ++y)
            for (int x = 0; x < print.width; ++x) {
                const int u = of.part.x0 + x * of.reduce, v = of.part.y0 + y * of.reduce;
                if (panel.area.contains(u, v))
                    put(print.rgba.data() + 4 * (std::size_t(y) * std::size_t(print.width) + std::size_t(x)),
                        colour_of_number((*of.picture)(u, v).r));
            }
    }
}

void put_codes(const std::vector<std::uint16_t>& rgb, Print& print) {
    print.rgba.assign(rgb.size() / 3 * 4, 255);
    for (std::size_t i = 0; i < rgb.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) print.rgba[4 * i + c] = std::uint8_t(rgb[3 * i + c]);
}

void print_light(const Negative& of, const Rect& part, const Darkroom::ToDisplay& to_display, Print& print) {
    Picture light = reduced(*of.picture, part, of.reduce);
    print.width = light.width(), print.height = light.height();
    isolate(light, of.channel);
    DevelopSettings settings = of.develop;
    if (of.channel == Channel::Alpha)  // coverage is not light
        settings.exposure_stops = 0, settings.tone = ToneCurve::None, settings.transfer = Transfer::Linear;
    if (of.ocio && to_display && of.channel != Channel::Alpha) {
        std::string used;
        std::vector<std::string> warnings;
        if (Status shown = to_display(light, settings, used, warnings); !shown) print.error = shown.error();
    }
    put_codes(develop(light, settings), print);
    if (of.panels) paint_numbers(of, print);
}

}  // namespace

bool Negative::operator==(const Negative& o) const {
    const auto same_display = [](const DevelopSettings& a, const DevelopSettings& b) {
        return a.exposure_stops == b.exposure_stops && a.contrast == b.contrast && a.tone == b.tone &&
               a.transfer == b.transfer;
    };
    return picture == o.picture && codes == o.codes && plane == o.plane && panels == o.panels &&
           area == o.area && part == o.part && reduce == o.reduce && numbers == o.numbers &&
           permissible_radius_px == o.permissible_radius_px && same_display(develop, o.develop) &&
           ocio == o.ocio && channel == o.channel;
}

Print developed(const Negative& negative, const Darkroom::ToDisplay& to_display) {
    Print print;
    print.of = negative;
    const Rect part = negative.part.moved(-negative.area.x0, -negative.area.y0);
    if (negative.codes)
        print.width = negative.codes->width, print.height = negative.codes->height,
        put_codes(negative.codes->rgb, print);
    else if (negative.numbers == Numbers::Light)
        print_light(negative, part, to_display, print);
    else
        print_numbers(negative, part, print);
    return print;
}

Darkroom::Darkroom(ToDisplay to_display, std::function<void()> wake)
    : to_display_(std::move(to_display)), wake_(std::move(wake)), thread_([this] { work(); }) {}

Darkroom::~Darkroom() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    something_.notify_all();
    thread_.join();
}

void Darkroom::print(int target, Negative negative) {
    const std::lock_guard lock(mutex_);
    waiting_[std::size_t(target)] = std::move(negative);
    something_.notify_all();
}

std::vector<Print> Darkroom::prints() {
    const std::lock_guard lock(mutex_);
    return std::exchange(done_, {});
}

bool Darkroom::is_idle() const {
    const std::lock_guard lock(mutex_);
    return !busy_ && done_.empty() &&
           std::none_of(waiting_.begin(), waiting_.end(), [](const auto& w) { return w.has_value(); });
}

void Darkroom::work() {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        std::size_t target = 0;
        while (target < kTargets && !waiting_[target]) ++target;
        if (target == kTargets) {
            something_.wait(lock);
            continue;
        }
        const Negative negative = std::move(*waiting_[target]);
        waiting_[target].reset();
        busy_ = true;
        lock.unlock();
        Print print;
        try {
            print = developed(negative, to_display_);
        } catch (const std::bad_alloc&) {
            print.of = negative;
            print.error = Error{ErrorCode::OutOfMemory, "not enough memory to show this picture"};
        }
        print.target = int(target);
        lock.lock();
        busy_ = false;
        done_.push_back(std::move(print));
        lock.unlock();
        wake_();
        lock.lock();
    }
}

}  // namespace petzval::view
