#include "app.h"

#include <algorithm>

namespace petzval::view {

void DraftTimes::note(int coarse, double seconds) {
    coarse = std::clamp(coarse, 1, kCoarsest);
    for (int finer = 1; finer < coarse; ++finer) seconds_[std::size_t(finer)] *= 0.9;  // it is tried again
    double& known = seconds_[std::size_t(coarse)];
    known = known > 0 ? 0.5 * (known + seconds) : seconds;
}

// fixed + all / coarse², from the finest and the coarsest that are known; from one alone, all is for pixels.
double DraftTimes::expected_s(int coarse) const {
    int fine = 0, rough = 0;
    for (int by = 1; by <= kCoarsest; ++by) {
        if (seconds_[std::size_t(by)] <= 0) continue;
        if (fine == 0) fine = by;
        rough = by;
    }
    if (fine == 0) return 0;
    const auto share = [](int by) { return 1.0 / (by * by); };
    const double fine_s = seconds_[std::size_t(fine)], rough_s = seconds_[std::size_t(rough)];
    double all_s = fine_s / share(fine);
    if (rough > fine) all_s = std::max(0.0, (fine_s - rough_s) / (share(fine) - share(rough)));
    const double fixed_s = std::max(0.0, rough_s - all_s * share(rough));
    return fixed_s + all_s * share(coarse);
}

}  // namespace petzval::view
