// The C interface: an input is a list of calls. Pictures have memory of the size that their structs name; all
// numbers, names and flags come from the input. A call that fails says why and writes no picture.
#include "petzval/petzval_c.h"

#include "fuzz/held_file.h"

#include <array>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace {

constexpr int kMostCalls = 6, kLargestSide = 24;
// Scatter gathers a disc's light in cells that grow with its radius, and visits each pixel of a cell, also
// beyond the picture: 18 x 2 pixels with a radius of 1e20 take 0.6 s in a release build, and over 40 s here.
constexpr int kLargestRadiusPx = 256, kFarthestReachPx = 175 + 4 * kLargestRadiusPx;

class Bytes {
public:
    Bytes(const std::uint8_t* bytes, std::size_t size) : at_(bytes), end_(bytes + size) {}
    bool empty() const { return at_ == end_; }
    int byte() { return empty() ? 0 : *at_++; }
    bool flag() { return (byte() & 1) != 0; }
    int below(int count) { return byte() % count; }
    template <typename Number>
    Number raw() {
        Number number{};
        for (std::size_t i = 0; i < sizeof number; ++i) reinterpret_cast<char*>(&number)[i] = char(byte());
        return number;
    }
    // Mostly numbers that occur, some that should not, and any bits at all.
    double number() {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        static constexpr std::array<double, 16> kNumbers{
            0, 1, 2.8, 36, 50, 0.5, -1, 1e-40, 1e-9, 1e20, 1e38, 1e300, kInfinity, -kInfinity, 1e9, 10};
        const int which = below(24);
        if (which < 16) return kNumbers[std::size_t(which)];
        if (which == 16) return std::numeric_limits<double>::quiet_NaN();
        return which < 20 ? double(byte()) / 16 : raw<double>();
    }
    std::string text() {
        std::string text;
        for (int left = below(48); left > 0 && !empty(); --left) text += char(byte());
        return text.substr(0, text.find('\0'));
    }

private:
    const std::uint8_t *at_, *end_;
};

// A picture of 32 x 32 pixels at most, in any layout that fits its memory.
struct Picture {
    std::vector<float> memory;
    petzval_pixels pixels{};
    petzval_plane plane{};

    Picture(Bytes& in, int width, int height) : memory(std::size_t(32 * 32 * 4)) {
        float repeated[8];
        for (float& value : repeated) value = float(in.number());
        for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = repeated[i / 4 % 8];
        const bool is_half = in.flag(), is_up = in.flag();
        const std::ptrdiff_t sample = is_half ? 2 : 4, row = std::ptrdiff_t(width) * 4 * sample;
        auto* const first =
            reinterpret_cast<char*>(memory.data()) + (is_up && height > 0 ? row * (height - 1) : 0);
        pixels.size = sizeof pixels;
        plane.size = sizeof plane;
        pixels.width = plane.width = width, pixels.height = plane.height = height;
        pixels.sample = plane.sample = is_half ? PETZVAL_HALF : PETZVAL_FLOAT;
        pixels.pixel_stride = plane.pixel_stride = 4 * sample;
        pixels.row_stride = plane.row_stride = is_up ? -row : row;
        pixels.r = first, pixels.g = first + sample, pixels.b = first + 2 * sample;
        pixels.a = in.flag() ? first + 3 * sample : nullptr;
        plane.data = first;
    }
};

struct Deep {
    std::vector<std::uint64_t> first;
    std::vector<petzval_deep_sample> samples;
    petzval_deep deep{};

    Deep(Bytes& in, int width, int height) {
        const int in_each = in.below(4);
        for (int i = 0; i <= width * height; ++i) first.push_back(std::uint64_t(i * in_each));
        petzval_deep_sample repeated[3];
        for (auto& s : repeated)
            s = {float(in.number()), float(in.number()), float(in.number()),
                 float(in.number()), float(in.number()), float(in.number())};
        for (std::uint64_t i = 0; i < first.back(); ++i) samples.push_back(repeated[i % 3]);
        if (in.below(8) == 0 && !first.empty()) first[first.size() / 2] = in.raw<std::uint64_t>();
        deep = {sizeof deep, width, height, first.data(), samples.data(), samples.size()};
    }
};

// All that a shot refers to.
struct Shot {
    Picture colour, plane, mask, layer_colour, layer_out;
    Deep deep, behind, holdout;
    petzval_camera camera{};
    std::vector<petzval_light> lights;
    petzval_layer layer{};
    const petzval_layer* layers = &layer;
    petzval_shot shot{};

    Shot(Bytes& in, int width, int height)
        : colour(in, width, height),
          plane(in, width, in.below(16) ? height : 1),
          mask(in, width, height),
          layer_colour(in, width, height),
          layer_out(in, width, height),
          deep(in, width, height),
          behind(in, width, height),
          holdout(in, width, height) {
        shot.size = sizeof shot;
        shot.colour = &colour.pixels;
        (in.flag() ? shot.depth_m : shot.radii_px) = &plane.plane;
        camera = {sizeof camera, in.number(), in.number(), in.number(), in.number(), in.below(3) - 1};
        if (in.below(8)) shot.camera = &camera;
        if (in.flag())
            shot.display_window = rect(in, width, height), shot.data_window = rect(in, width, height);
        if (in.flag()) shot.pixel_aspect = in.number();
        if (in.flag()) shot.deep = &deep.deep;
        if (in.flag()) shot.behind = &behind.deep;
        if (in.flag()) shot.holdout = &holdout.deep;
        for (int left = in.below(4); left > 0; --left)
            lights.push_back({float(in.number()), float(in.number()), float(in.number()), float(in.number()),
                              float(in.number()), float(in.number()), float(in.number()),
                              float(in.number())});
        shot.lights = lights.data();
        shot.light_count = lights.size();
        if (in.flag()) shot.mask = &mask.plane;
        layer = {sizeof layer, &layer_colour.pixels, in.below(3), in.flag() ? "sodium" : nullptr,
                 &layer_out.pixels};
        if (in.flag()) shot.layer_count = 1;
        if (shot.layer_count == 1) shot.layers = &layers;
    }
    static petzval_rect rect(Bytes& in, int width, int height) {
        if (in.below(4) == 0) return {in.raw<int>(), in.raw<int>(), in.raw<int>(), in.raw<int>()};
        const int x = in.below(9) - 4, y = in.below(9) - 4;
        return {x, y, x + width, y + height};
    }
};

void check(petzval_status status) {
    if (status == PETZVAL_OK) return;
    petzval::fuzz::check_message(petzval_error_text());
    if (status == PETZVAL_INTERNAL || std::strcmp(petzval_status_name(status), "unknown") == 0) {
        std::fprintf(stderr, "%d: %s\n", int(status), petzval_error_text());
        std::abort();
    }
}

petzval_session* session() {
    static petzval_session* const opened = [] {
        petzval_session_settings settings{};
        settings.size = sizeof settings;
        settings.threads = 1;
        settings.max_memory_bytes = std::uint64_t(512) << 20;
        petzval_session* made = nullptr;
        check(petzval_session_open(&settings, &made));
        std::atexit([] { petzval_session_close(session()); });
        return made;
    }();
    return opened;
}

void render(Bytes& in, const petzval_look* look) {
    const int width = in.below(kLargestSide + 1), height = in.below(kLargestSide + 1);
    Shot shot(in, width, height);
    Picture out(in, in.below(16) ? width : in.below(kLargestSide), height);
    petzval_control control{};
    control.size = sizeof control;
    if (in.below(8) == 0) control.region = Shot::rect(in, width, height);
    if (in.below(8) == 0) control.cancelled = [](void*) { return 1; };
    int margin = 0;
    check(petzval_region_margin_px(session(), &shot.shot, look, &margin));
    if (margin > kFarthestReachPx) return;
    const std::vector<float> before = out.memory;
    petzval_report* report = nullptr;
    const petzval_status done = petzval_defocus(session(), &shot.shot, look, &control, &out.pixels, &report);
    check(done);
    if (done == PETZVAL_OK && !petzval_report_json(report)) std::abort();
    if (done != PETZVAL_OK &&
        std::memcmp(before.data(), out.memory.data(), before.size() * sizeof(float)) != 0) {
        std::fprintf(stderr, "a failed call wrote a picture\n");
        std::abort();
    }
    petzval_report_close(report);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static constexpr const char* kFields[] = {"engine",        "lens.blades", "lens.name", "quality",
                                              "lens.cats_eye", "glare.bloom", "depth",     "scatter",
                                              "lens",          "samples"};
    static constexpr const char* kValues[] = {"scatter",   "gather",      "gaussian", "sprites",
                                              "reference", "draft",       "realtime", "0.5",
                                              "6",         "\"doublet\"", "petzval",  "-1"};
    Bytes in(bytes, size);
    petzval_look* look = nullptr;
    check(petzval_look_new(&look));
    for (int call = 0; call < kMostCalls && !in.empty(); ++call) {
        const int which = in.below(8);
        if (which < 3) {
            render(in, look);
        } else if (which < 6) {
            const std::string field = in.flag() ? in.text() : kFields[in.below(10)];
            const std::string value = in.flag() ? in.text() : kValues[in.below(12)];
            check(petzval_look_set(look, field.c_str(), value.c_str()));
        } else if (which == 6) {
            petzval_look* other = nullptr;
            const petzval_status read = petzval_look_from_json(in.text().c_str(), &other);
            check(read);
            if (read == PETZVAL_OK) std::swap(look, other);
            petzval_look_close(other);
        } else {
            check(petzval_session_trim(session(), in.raw<std::uint64_t>()));
            petzval_usage usage{sizeof usage, 0, 0};
            check(petzval_session_usage(session(), &usage));
        }
    }
    petzval_look_close(look);
    return 0;
}
