// The text of a comparison: of one pair of pictures, and of the frames of a shot.
#include "petzval/shots/compare_files.h"

#include <array>
#include <cstdio>

namespace petzval {
namespace {

std::string table(const Comparison& c) {
    std::array<char, 512> text{};
    std::snprintf(text.data(), text.size(),
                  "%-16s%10s%10s%10s\n"
                  "%-16s%10.2f%10.2f%10.2f\n"
                  "%-16s%10.4f%10.4f\n"
                  "%-16s%10.4g  at pixel %d,%d\n"
                  "%-16s%10.6f\n",
                  "", "linear", "sRGB", "log", "PSNR, dB", c.psnr_lin, c.psnr_srgb, c.psnr_log, "SSIM",
                  c.ssim_lin, c.ssim_srgb, "largest error", c.max_error, c.max_error_x, c.max_error_y,
                  "energy ratio", c.energy_ratio);
    return text.data();
}

std::string places_text(const std::vector<WorstPlace>& worst) {
    std::string text;
    for (std::size_t i = 0; i < worst.size(); ++i) {
        const Rect& r = worst[i].area;
        std::array<char, 120> line{};
        std::snprintf(line.data(), line.size(), "%-16s%d,%d to %d,%d: %.2f codes RMS\n",
                      ("worst place " + std::to_string(i + 1)).c_str(), r.x0, r.y0, r.x1, r.y1,
                      255 * worst[i].rms);
        text += line.data();
    }
    return text;
}

std::string row(int frame, const Comparison& c) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%-8s%14.2f%14.2f%12.4f%16.4g%14.6f\n",
                  std::to_string(frame).c_str(), c.psnr_lin, c.psnr_srgb, c.ssim_srgb, c.max_error,
                  c.energy_ratio);
    return text.data();
}

}  // namespace

std::string comparison_text(const ComparedFiles& compared) {
    return table(compared.comparison) + places_text(compared.worst);
}

void ComparedShot::add(int frame, const ComparedFiles& compared) {
    const Comparison& c = compared.comparison;
    rows_ += row(frame, c);
    sum_.psnr_lin += c.psnr_lin;
    sum_.psnr_srgb += c.psnr_srgb;
    sum_.ssim_srgb += c.ssim_srgb;
    if (count_++ == 0 || c.psnr_lin < worst_.psnr_lin) {
        worst_ = c;
        worst_frame_ = frame;
        places_ = places_text(compared.worst);
    }
}

std::optional<int> ComparedShot::worst_frame() const {
    return count_ == 0 ? std::nullopt : std::optional(worst_frame_);
}

// A shot is as good as its worst frame.
std::string ComparedShot::text() const {
    if (count_ == 0) return "";
    std::array<char, 160> head{}, mean{};
    std::snprintf(head.data(), head.size(), "%-8s%14s%14s%12s%16s%14s\n", "frame", "PSNR lin dB",
                  "PSNR sRGB dB", "SSIM sRGB", "largest error", "energy ratio");
    std::snprintf(mean.data(), mean.size(), "%-8s%14.2f%14.2f%12.4f\n", "mean", sum_.psnr_lin / count_,
                  sum_.psnr_srgb / count_, sum_.ssim_srgb / count_);
    return head.data() + rows_ + mean.data() + "worst is frame " + std::to_string(worst_frame_) + "\n" +
           places_;
}

}  // namespace petzval
