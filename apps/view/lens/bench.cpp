#include "bench.h"

#include "petzval/camera.h"
#include "petzval/develop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <tuple>
#include <utility>

namespace petzval::view {
namespace {

// The brightest pixel white: what shows is the disc's structure.
LensCodes codes_of(const Picture& weights) {
    float most = 1e-30f;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const Rgba& p = weights.pixels()[i];
        most = std::max({most, p.r, p.g, p.b});
    }
    LensCodes codes{weights.width(), weights.height(), {}};
    codes.rgba.reserve(4 * weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const Rgba& p = weights.pixels()[i];
        for (const float value : {p.r, p.g, p.b})
            codes.rgba.push_back(std::uint8_t(std::lround(255 * srgb_encode(double(value / most)))));
        codes.rgba.push_back(255);
    }
    return codes;
}

void put(const LensCodes& disc, LensCodes& onto, int middle_x) {
    for (int y = 0; y < disc.height; ++y)
        for (int x = 0; x < disc.width; ++x) {
            const int u = middle_x + x - disc.width / 2, v = onto.height / 2 + y - disc.height / 2;
            if (u < 0 || v < 0 || u >= onto.width || v >= onto.height) continue;
            const std::ptrdiff_t of = 4 * (std::ptrdiff_t(y) * disc.width + x),
                                 at = 4 * (std::ptrdiff_t(v) * onto.width + u);
            std::copy_n(disc.rgba.begin() + of, 4, onto.rgba.begin() + at);
        }
}

std::vector<double> strip_radii() {
    std::vector<double> radii;
    for (int i = 0; i < kStripDiscs; ++i) radii.push_back(kStripReach_px * (2.0 * i / (kStripDiscs - 1) - 1));
    return radii;
}

LensCodes strip_of(const std::vector<LensDisc>& discs) {
    const int cell = int(2 * kStripReach_px + 8);
    LensCodes strip{cell * kStripDiscs, cell, {}};
    strip.rgba.assign(4 * std::size_t(strip.width) * std::size_t(strip.height), 0);
    for (std::size_t i = 3; i < strip.rgba.size(); i += 4) strip.rgba[i] = 255;
    for (std::size_t i = 0; i < discs.size(); ++i)
        put(codes_of(discs[i].weights), strip, int(i) * cell + cell / 2);
    return strip;
}

Status make_discs(const Lens& lens, LensMade& made) {
    const LensWish& wish = made.of;
    const std::array<double, 2> radii{-made.side_px, made.side_px};
    const auto discs = lens_point_spreads(lens, wish.mount, radii, wish.field_x, wish.field_y);
    if (!discs) return discs.error();
    made.front = codes_of((*discs)[0].weights);
    made.behind = codes_of((*discs)[1].weights);
    made.words = (*discs)[0].lens;
    // A small disc is shown as a sensor of smaller pixels would see it.
    constexpr double kLarge_px = 48;
    constexpr int kFinest = 16;
    made.fine = std::clamp(int(kLarge_px / std::max(std::abs(made.coc_px), 1.0)), 1, kFinest);
    LensMount fine = wish.mount;
    fine.width_px *= made.fine, fine.height_px *= made.fine;
    const std::array<double, 1> radius{made.fine * made.coc_px};
    const auto disc = lens_point_spreads(lens, fine, radius, wish.field_x, wish.field_y);
    if (!disc) return disc.error();
    made.disc = codes_of((*disc)[0].weights);
    const auto strip = lens_point_spreads(lens, wish.mount, strip_radii());
    if (!strip) return strip.error();
    made.strip = strip_of(*strip);
    return Done{};
}

// The least mean square of blur: zones count by their area times the square of their height.
double best_focus_mm(const LongitudinalAberrationFacts& curves, double open_share) {
    double sum = 0, weights = 0;
    for (const auto& curve : curves.shift_mm)
        for (std::size_t z = 0; z < curve.size(); ++z) {
            const double zone = curves.zones[z];
            if (!std::isfinite(curve[z]) || zone > open_share) continue;
            sum += zone * zone * zone * curve[z], weights += zone * zone * zone;
        }
    return weights > 0 ? sum / weights : 0;
}

void note_facts(const LensFacts& facts, LensMade& made) {
    made.curves = facts.longitudinal_aberration;
    if (!(facts.efl_mm > 0)) return;
    const Camera& camera = made.of.mount.camera;
    const double scale = camera.focal_length_mm / facts.efl_mm;
    made.best_focus_mm = scale * best_focus_mm(made.curves, facts.f_number / camera.f_number);
    if (!facts.has_prescription) return;
    made.opens_to = facts.f_number, made.pupil_z_mm = scale * facts.entrance_pupil_position_mm;
}

Status measure(LensMade& made) {
    const LensWish& wish = made.of;
    const auto lens = Lens::open(wish.choice);
    if (!lens) return lens.error();
    const auto coc = CircleOfConfusion::make(wish.mount.camera, wish.mount.width_px);
    if (!coc) return coc.error();
    made.coc_px = std::clamp(coc->radius_px(wish.depth_m), -400.0, 400.0);
    made.side_px = std::max(40.0, std::abs(made.coc_px));
    if (Status done = make_discs(*lens, made); !done) return done;
    if (const auto facts = lens_facts(*lens)) note_facts(*facts, made);
    auto section = lens_section(*lens, wish.mount, wish.depth_m, wish.field_x, wish.field_y);
    if (!section) return section.error();
    made.section = std::move(*section);
    return Done{};
}

}  // namespace

bool LensWish::operator==(const LensWish& o) const {
    const auto camera_of = [](const LensWish& w) {
        const Camera& c = w.mount.camera;
        return std::tuple(c.focal_length_mm, c.sensor_width_mm, c.f_number, c.focus_distance_m, c.image_scale,
                          w.mount.width_px, w.mount.height_px, w.mount.pixel_aspect, w.field_x, w.field_y,
                          w.depth_m);
    };
    return choice == o.choice && camera_of(*this) == camera_of(o);
}

LensMade on_bench(const LensWish& wish) {
    LensMade made;
    made.of = wish;
    if (Status done = measure(made); !done) made.error = done.error();
    return made;
}

LensBench::LensBench(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { work(); }) {}

LensBench::~LensBench() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    something_.notify_all();
    thread_.join();
}

void LensBench::make(LensWish wish) {
    const std::lock_guard lock(mutex_);
    wish_ = std::move(wish);
    something_.notify_all();
}

std::vector<LensMade> LensBench::news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, {});
}

bool LensBench::is_idle() const {
    const std::lock_guard lock(mutex_);
    return !busy_ && !wish_ && news_.empty();
}

void LensBench::work() {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (!wish_) {
            something_.wait(lock);
            continue;
        }
        const LensWish wish = std::move(*wish_);
        wish_.reset();
        busy_ = true;
        lock.unlock();
        LensMade made;
        try {
            made = on_bench(wish);
        } catch (const std::bad_alloc&) {
            made.error = Error{ErrorCode::OutOfMemory, "not enough memory for these discs"};
        }
        lock.lock();
        busy_ = false;
        news_.push_back(std::move(made));
        lock.unlock();
        wake_();
        lock.lock();
    }
}

}  // namespace petzval::view
