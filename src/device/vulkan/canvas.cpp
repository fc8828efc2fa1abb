#include "device/vulkan/canvas.h"

#include "device/failure.h"

#include <algorithm>
#include <array>
#include <utility>

namespace petzval::device::vulkan {

bool DeviceCanvas::has_room() {
    if (pixels_.size() > 0) return true;
    if (!fits()) return false;
    try {
        pixels_ = context_.heap().allocate(Kind::OnDevice, memory_.bytes());
    } catch (const Failed& failed) {
        if (failed.error.code != ErrorCode::OutOfMemory) throw;
        return false;
    }
    return true;
}

const Piece* DeviceCanvas::drawn_on() {
    if (!is_home_ && !has_room()) is_home_ = true;
    return is_home_ ? nullptr : &pixels_;
}

const Piece* DeviceCanvas::sent() {
    if (!is_home_) return drawn_on();
    if (!fits()) return nullptr;
    Recording recording(context_);
    Piece pixels = recording.uploaded(std::span<const Rgba>(memory_.pixels(), memory_.size()));
    recording.run();
    pixels_ = std::move(pixels), is_home_ = false;
    return &pixels_;
}

void DeviceCanvas::come_home() {
    is_home_ = true;
    if (pixels_.size() == 0) return;
    for (std::size_t begin = 0; begin < memory_.size();) {
        const std::size_t pixels = std::min(context_.at_once(memory_.size()), memory_.size() - begin);
        try {
            bring_home(begin, pixels);
            begin += pixels;
        } catch (const Failed& failed) {
            if (!context_.halves(failed)) throw;
        }
    }
    pixels_ = {};
}

void DeviceCanvas::bring_home(std::size_t begin, std::size_t pixels) {
    const Piece seen = context_.heap().allocate(Kind::FromDevice, pixels * sizeof(Rgba));
    Recording recording(context_);
    recording.copy(pixels_, seen, pixels * sizeof(Rgba), begin * sizeof(Rgba));
    recording.run();
    std::copy_n(reinterpret_cast<const Rgba*>(seen.mapped()), pixels, memory_.pixels() + begin);
}

Delivery::Delivery(Context& context, Target out) : context_(context), out_(out) {
    if (auto* const canvas = dynamic_cast<DeviceCanvas*>(out.canvas())) away_ = canvas->drawn_on();
}

void Delivery::squares(Recording& recording, const Piece& drawn, std::span<const Rect> places, int side,
                       bool adds) {
    const std::size_t square = std::size_t(side) * std::size_t(side);
    if (!away_) {
        places_.assign(places.begin(), places.end());
        side_ = side, square_ = square, adds_ = adds;
        seen_ =
            reinterpret_cast<const Rgba*>(recording.downloaded(drawn, places.size() * square * sizeof(Rgba)));
        return;
    }
    std::vector<std::uint32_t> words;
    for (const Rect& r : places)
        words.insert(words.end(),
                     {std::uint32_t(r.x0), std::uint32_t(r.y0), std::uint32_t(r.x1), std::uint32_t(r.y1)});
    words_ = recording.uploaded(std::span<const std::uint32_t>(words));
    const std::array push{std::uint32_t(side), std::uint32_t(out_.canvas()->width()),
                          std::uint32_t(adds ? 1 : 0)};
    recording.pass("place tiles", context_.program(Shader::PlaceTiles), {&words_, &drawn, away_}, push,
                   {std::uint32_t((square + 255) / 256), std::uint32_t(places.size())});
}

void Delivery::rows(Recording& recording, const Piece& drawn, int first, int y0, int y1) {
    const int width = away_ ? out_.canvas()->width() : out_.view().width();
    const auto bytes = [&](int row_count) {
        return std::size_t(row_count) * std::size_t(width) * sizeof(Rgba);
    };
    if (away_) {
        recording.copy(drawn, *away_, bytes(y1 - y0), bytes(y0 - first), bytes(y0));
        return;
    }
    places_ = {{0, y0, width, y1}};
    side_ = width;
    seen_ = reinterpret_cast<const Rgba*>(recording.downloaded(drawn, bytes(y1 - first))) +
            std::size_t(y0 - first) * std::size_t(width);
}

void Delivery::finish() {
    if (away_) return;
    const View<Rgba> out = out_.view();
    const Rgba* square = seen_;
    for (const Rect& place : places_) {
        const Rgba* from = square;
        for (int y = place.y0; y < place.y1; ++y, from += side_) {
            Rgba* const to = out.row(y) + place.x0;
            if (adds_)
                for (int x = 0; x < place.width(); ++x) to[x] += from[x];
            else
                std::copy_n(from, place.width(), to);
        }
        square += square_;
    }
}

}  // namespace petzval::device::vulkan
