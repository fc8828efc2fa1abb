#include "pixels.h"

#include "rules.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sys/mman.h>
#include <unistd.h>

namespace ofx_check {
namespace {

constexpr unsigned char kAround = 0xA5;
constexpr std::uint32_t kSentinel = 0x7fa55aa5;  // a NaN that no arithmetic makes
constexpr std::size_t kMargin = 64;

enum class State : int { None, Written, Input, Released };
// Images that the signal handler knows.
struct Region {
    std::atomic<char*> begin{nullptr}, end{nullptr};
    std::atomic<State> state{State::None};
};
std::array<Region, 512> regions;
std::atomic<int> region_count{0};

void on_fault(int, siginfo_t* fault, void*) {
    const char* at = static_cast<const char*>(fault->si_addr);
    for (const Region& region : regions) {
        if (!(at >= region.begin.load() && at < region.end.load())) continue;
        switch (region.state.load()) {
            case State::Released:
                broken("images.after_release", "its memory was used");
                break;
            case State::Input:
                broken("images.input", "an input or memory beside it was written or read");
                break;
            default:
                broken("images.bounds", "memory more than 64 bytes beside an image was used");
        }
        _exit(kMemoryTouched);
    }
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
}

std::size_t in_pages(std::size_t bytes) {
    const auto page = std::size_t(sysconf(_SC_PAGESIZE));
    return (bytes + page - 1) / page * page;
}

}  // namespace

Picture::Picture(const ofx::RectI& where, int channel_count) : bounds(where), channels(channel_count) {
    values.resize(std::size_t(width()) * std::size_t(height()) * std::size_t(channels));
}

std::size_t bytes_of(Depth depth) {
    if (depth == Depth::Float) return 4;
    return depth == Depth::Short ? 2 : 1;
}

void watch_memory() {
    struct sigaction action {};
    action.sa_sigaction = on_fault;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGSEGV, &action, nullptr);
    sigaction(SIGBUS, &action, nullptr);
}

GuardedImage::GuardedImage(const Picture& picture, Depth depth, const Layout& layout, bool sentinel)
    : bounds_(picture.bounds), channels_(picture.channels), depth_(depth) {
    const std::size_t row_length = std::size_t(picture.width()) * std::size_t(channels_) * bytes_of(depth);
    const std::size_t step = row_length + std::size_t(layout.padding);
    const std::size_t size = step * std::size_t(picture.height());
    const std::size_t inner = in_pages(size + 2 * kMargin), page = in_pages(1);
    page_bytes_ = inner + 2 * page;
    void* got = mmap(nullptr, page_bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (got == MAP_FAILED) std::abort();
    pages_ = static_cast<char*>(got);
    mprotect(pages_ + page, inner, PROT_READ | PROT_WRITE);
    std::memset(pages_ + page, kAround, inner);
    begin_ = pages_ + page + kMargin;
    end_ = begin_ + size;
    row_bytes_ = layout.flipped ? -int(step) : int(step);
    first_row_ = layout.flipped ? begin_ + std::ptrdiff_t(step) * (picture.height() - 1) : begin_;
    const std::size_t count = std::size_t(picture.width()) * std::size_t(channels_);
    for (int y = 0; y < picture.height(); ++y)
        for (std::size_t i = 0; i < count; ++i) {
            const float value = picture.values[std::size_t(y) * count + i];
            char* to = row(y) + i * bytes_of(depth);
            const double share = std::clamp(double(value), 0.0, 1.0);
            const auto as_byte = std::uint8_t(std::lround(share * 255));
            const auto as_short = std::uint16_t(std::lround(share * 65535));
            if (depth == Depth::Float)
                std::memcpy(to, sentinel ? static_cast<const void*>(&kSentinel) : &value, 4);
            if (depth == Depth::Short) std::memcpy(to, &as_short, 2);
            if (depth == Depth::Byte) std::memcpy(to, &as_byte, 1);
        }
    slot_ = region_count++ % int(regions.size());
    Region& region = regions[std::size_t(slot_)];
    region.begin = pages_;
    region.end = pages_ + page_bytes_;
    region.state = State::Written;
}

GuardedImage::~GuardedImage() {
    if (pages_) give_back();
}

void GuardedImage::make_read_only() {
    mprotect(pages_, page_bytes_, PROT_NONE);
    const std::size_t page = in_pages(1);
    mprotect(pages_ + page, page_bytes_ - 2 * page, PROT_READ);
    regions[std::size_t(slot_)].state = State::Input;
}

void GuardedImage::give_back() {
    mprotect(pages_, page_bytes_, PROT_NONE);
    madvise(pages_, page_bytes_, MADV_DONTNEED);
    regions[std::size_t(slot_)].state = State::Released;
    pages_ = nullptr;
}

Picture GuardedImage::read() const {
    Picture picture(bounds_, channels_);
    const std::size_t count = std::size_t(picture.width()) * std::size_t(channels_);
    for (int y = 0; y < picture.height(); ++y)
        for (std::size_t i = 0; i < count; ++i) {
            const char* from = row(y) + i * bytes_of(depth_);
            float& value = picture.values[std::size_t(y) * count + i];
            std::uint8_t as_byte = 0;
            std::uint16_t as_short = 0;
            if (depth_ == Depth::Float) std::memcpy(&value, from, 4);
            if (depth_ == Depth::Short) {
                std::memcpy(&as_short, from, 2);
                value = float(as_short) / 65535;
            }
            if (depth_ == Depth::Byte) {
                std::memcpy(&as_byte, from, 1);
                value = float(as_byte) / 255;
            }
            if (depth_ == Depth::Float && std::bit_cast<std::uint32_t>(value) == kSentinel)
                value = std::numeric_limits<float>::quiet_NaN();
        }
    return picture;
}

bool GuardedImage::surroundings_are_whole() const {
    const std::size_t page = in_pages(1);
    const auto is_whole = [](const char* from, const char* to) {
        return std::all_of(from, to, [](char c) { return static_cast<unsigned char>(c) == kAround; });
    };
    if (!is_whole(pages_ + page, begin_) || !is_whole(end_, pages_ + page_bytes_ - page)) return false;
    const std::size_t length =
        std::size_t(bounds_.x2 - bounds_.x1) * std::size_t(channels_) * bytes_of(depth_);
    const std::size_t step = std::size_t(std::abs(row_bytes_));
    for (const char* at = begin_; at < end_; at += step)
        if (!is_whole(at + length, at + step)) return false;
    return true;
}

}  // namespace ofx_check
