#include "console/progress.h"

#include "console/interrupt.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace petzval::cli {

ProgressLine::ProgressLine(ProgressMode mode, bool quiet, std::string stage) : stage_(std::move(stage)) {
    switch (mode) {
        case ProgressMode::Off:
            style_ = Style::None;
            break;
        case ProgressMode::Plain:
            style_ = Style::Plain;
            break;
        case ProgressMode::JsonLines:
            style_ = Style::JsonLines;
            break;
        default:
            style_ = quiet ? Style::None : isatty(STDERR_FILENO) ? Style::Bar : Style::Plain;
    }
}

ProgressLine::~ProgressLine() {
    if (style_ == Style::Bar && on_screen_) std::fputs("\r\x1b[K", stderr);
}

bool ProgressLine::operator()(double share) {
    if (interrupted_by() != 0) return false;
    if (style_ == Style::None) return true;
    // Bars and JSON are updated ten times a second, logs once; JSON also reports the end.
    const auto interval = std::chrono::milliseconds(style_ == Style::Plain ? 1000 : 100);
    const auto now = Clock::now();
    // Shares are summed by the library and may miss 1 by their rounding.
    const bool end = style_ == Style::JsonLines && share > 1 - 1e-6 && !ended_;
    if (now - drawn_ >= interval || end) {
        ended_ = end;
        drawn_ = now;
        on_screen_ = true;
        draw(std::clamp(share, 0.0, 1.0), std::chrono::duration<double>(now - start_).count());
    }
    return true;
}

void ProgressLine::draw(double share, double elapsed_s) const {
    const int percent = int(100 * share);
    if (style_ == Style::Plain) {
        std::fprintf(stderr, "progress %d%%\n", percent);
    } else if (style_ == Style::JsonLines) {
        std::fprintf(stderr, "{\"stage\":\"%s\",\"progress\":%.4f,\"seconds\":%.2f}\n", stage_.c_str(), share,
                     elapsed_s);
    } else {
        constexpr int kCells = 30;
        const int full = int(kCells * share);
        std::string bar = std::string(std::size_t(full), '#') + std::string(std::size_t(kCells - full), '.');
        std::fprintf(stderr, "\r%s [%s] %3d%%", stage_.c_str(), bar.c_str(), percent);
        if (share > 0.02) std::fprintf(stderr, "  %.0f s left", elapsed_s * (1 - share) / share);
        std::fputs("\x1b[K", stderr);
    }
    std::fflush(stderr);
}

}  // namespace petzval::cli
