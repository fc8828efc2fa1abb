#include "history.h"

#include <tuple>
#include <utility>

namespace petzval::view {
namespace {

auto numbers_of(const CameraChoice& c) {
    return std::tie(c.focal_length_mm, c.sensor_width_mm, c.f_number, c.focus_distance_m, c.image_scale,
                    c.aperture_diameter_mm);
}
auto display_of(const Choice& c) {
    return std::tie(c.develop.exposure_stops, c.develop.contrast, c.develop.tone, c.ocio, c.scene_camera);
}

}  // namespace

bool same(const Chosen& a, const Chosen& b) {
    return a.choice.input == b.choice.input && numbers_of(a.choice.camera) == numbers_of(b.choice.camera) &&
           a.choice.look == b.choice.look && display_of(a.choice) == display_of(b.choice) &&
           a.keys == b.keys && a.easing == b.easing && a.focus_speed == b.focus_speed;
}

void History::settle(const Chosen& now) {
    constexpr std::size_t kMostSteps = 500;
    if (settled_ && same(*settled_, now)) return;
    if (settled_) before_.push_back(*settled_);
    if (before_.size() > kMostSteps) before_.erase(before_.begin());
    after_.clear();
    settled_ = now;
}

void History::forget() {
    settled_.reset();
    before_.clear();
    after_.clear();
}

std::optional<Chosen> History::undo() {
    if (before_.empty()) return std::nullopt;
    after_.push_back(std::exchange(*settled_, before_.back()));
    before_.pop_back();
    return settled_;
}

std::optional<Chosen> History::redo() {
    if (after_.empty()) return std::nullopt;
    before_.push_back(std::exchange(*settled_, after_.back()));
    after_.pop_back();
    return settled_;
}

}  // namespace petzval::view
