#include "images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace petzval::plugin {
namespace {

int channels_of(const std::string& components) {
    if (components == ofx::kRgba) return 4;
    if (components == ofx::kRgb) return 3;
    return components == ofx::kAlpha ? 1 : 0;
}

constexpr int kLargestSide = 1 << 20;  // as the library has it

ofx::Clip* clip_of(ofx::Effect* effect, const char* name, ofx::PropertySet** set) {
    ofx::Clip* clip = nullptr;
    if (suites().effect->clip_handle(effect, name, &clip, set) != ofx::kOk) return nullptr;
    return clip;
}

bool is_sound(const ofx::RectI& r) {
    const auto side = [](int low, int high) { return double(high) - double(low); };
    return !is_empty(r) && side(r.x1, r.x2) <= kLargestSide && side(r.y1, r.y2) <= kLargestSide;
}

}  // namespace

LentImage::LentImage(ofx::Effect* effect, const char* name, ofx::Time time) {
    ofx::PropertySet* image = nullptr;
    ofx::Clip* clip = clip_of(effect, name, nullptr);
    if (!clip || suites().effect->clip_image(clip, time, nullptr, &image) != ofx::kOk) return;
    image_ = Properties(image);
    data_ = static_cast<char*>(image_.pointer(ofx::kData));
    row_bytes_ = image_.integer(ofx::kRowBytes);
    const bool bounded = image_.rect(ofx::kBounds, bounds_) && is_sound(bounds_);
    if (!image_.rect(ofx::kImageRegion, region_) || !is_sound(region_)) region_ = bounds_;
    const double aspect = image_.number(ofx::kPixelAspect, 1);
    pixel_aspect_ = aspect > 0 ? aspect : 1;
    unpremultiplied_ = image_.text(ofx::kPreMultiplication) == ofx::kUnPreMultiplied;
    const int channels = channels_of(image_.text(ofx::kComponents));
    if (!data_ || !bounded || image_.text(ofx::kPixelDepth) != ofx::kFloat) return;
    // Rows that overlap are not rows.
    const std::ptrdiff_t least = std::ptrdiff_t(width()) * channels * std::ptrdiff_t(sizeof(float));
    if (height() == 1 || std::abs(row_bytes_) >= least) channels_ = channels;
}

LentImage::~LentImage() {
    if (is_there()) suites().effect->release_image(image_.handle());
}

float LentImage::value(int x, int y, int channel, float outside) const {
    if (x < bounds_.x1 || x >= bounds_.x2 || y < bounds_.y1 || y >= bounds_.y2) return outside;
    float value = 0;
    std::memcpy(&value, pixel(x, y) + std::size_t(channel) * sizeof value, sizeof value);
    return value;
}

bool LentImage::is_aligned() const {
    return reinterpret_cast<std::uintptr_t>(data_) % alignof(float) == 0 &&
           row_bytes_ % std::ptrdiff_t(alignof(float)) == 0;
}

bool is_connected(ofx::Effect* effect, const char* name) {
    ofx::PropertySet* set = nullptr;
    return clip_of(effect, name, &set) && Properties(set).integer(ofx::kConnected) != 0;
}

ofx::RectI intersected(const ofx::RectI& a, const ofx::RectI& b) {
    return {std::max(a.x1, b.x1), std::max(a.y1, b.y1), std::min(a.x2, b.x2), std::min(a.y2, b.y2)};
}

FrameOfHost frame_of(ofx::Effect* effect, const LentImage& source, ofx::Point scale, bool spans_source) {
    FrameOfHost frame{source.region(), source.pixel_aspect() * scale.y / scale.x};
    const Properties project = properties_of(effect);
    const ofx::Point size = project.point(ofx::kProjectSize, {0, 0});
    const ofx::Point offset = project.point(ofx::kProjectOffset, {0, 0});
    const double across = scale.x / source.pixel_aspect();
    const auto px = [](double at) { return int(std::lround(std::clamp(at, -1e9, 1e9))); };
    const ofx::RectI whole{px(offset.x * across), px(offset.y * scale.y), px((offset.x + size.x) * across),
                           px((offset.y + size.y) * scale.y)};
    if (!spans_source && is_sound(whole)) frame.display = whole;
    return frame;
}

petzval_pixels pixels_of(const LentImage& image, const ofx::RectI& part) {
    float* top_left = reinterpret_cast<float*>(image.pixel(part.x1, part.y2 - 1));
    petzval_pixels p{};
    p.size = sizeof p;
    p.width = part.x2 - part.x1;
    p.height = part.y2 - part.y1;
    p.sample = PETZVAL_FLOAT;
    p.r = top_left;
    p.g = top_left + 1;
    p.b = top_left + 2;
    p.a = top_left + 3;
    p.pixel_stride = 4 * sizeof(float);
    p.row_stride = -image.row_bytes();
    return p;
}

std::vector<float> light_of(const LentImage& image, const Coding& coding, bool opaque) {
    std::vector<float> copy(std::size_t(image.width()) * std::size_t(image.height()) * 4);
    const std::size_t row = std::size_t(image.width()) * 4;
    for (int y = 0; y < image.height(); ++y)
        std::memcpy(copy.data() + std::size_t(y) * row,
                    image.pixel(image.bounds().x1, image.bounds().y2 - 1 - y), row * sizeof(float));
    for (std::size_t i = 0; i < copy.size(); i += 4) {
        if (opaque) copy[i + 3] = 1;
        coding.to_light(copy.data() + i);
    }
    return copy;
}

petzval_pixels pixels_of(std::vector<float>& rgba, int width, int height) {
    petzval_pixels p{};
    p.size = sizeof p;
    p.width = width;
    p.height = height;
    p.r = rgba.data();
    p.g = rgba.data() + 1;
    p.b = rgba.data() + 2;
    p.a = rgba.data() + 3;
    p.pixel_stride = 4 * sizeof(float);
    p.row_stride = p.pixel_stride * width;
    return p;
}

}  // namespace petzval::plugin
