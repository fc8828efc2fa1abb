// Progress: a bar on a terminal, one plain line per second elsewhere, or JSON lines for programs.
#pragma once

#include <chrono>
#include <string>

namespace petzval::cli {

enum class ProgressMode { Auto, Plain, JsonLines, Off };

// Given to the library as its progress callback. Standard error only.
class ProgressLine {
public:
    // Auto: a bar if standard error is a terminal, else plain; nothing with -q.
    ProgressLine(ProgressMode mode, bool quiet, std::string stage);
    ~ProgressLine();  // takes the bar off the screen
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    // Returns false once a signal has asked us to stop.
    bool operator()(double share);

private:
    using Clock = std::chrono::steady_clock;
    enum class Style { Bar, Plain, JsonLines, None };
    void draw(double share, double elapsed_s) const;

    Style style_;
    std::string stage_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point drawn_ = start_;
    bool on_screen_ = false, ended_ = false;
};

}  // namespace petzval::cli
