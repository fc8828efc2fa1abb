// The thread that puts a lens on the bench: in section with rays, its discs, its curves.
#pragma once

#include "petzval/lens_choice.h"
#include "petzval/lens_facts.h"
#include "petzval/lens_kernel.h"
#include "petzval/lens_section.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace petzval::view {

// A pixel, its lens, and the origin of its light.
struct LensWish {
    LensChoice choice;
    LensMount mount;
    double field_x = 0, field_y = 0, depth_m = 0;

    bool operator==(const LensWish& other) const;
};

// A picture as the screen wants it.
struct LensCodes {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

struct LensMade {
    static constexpr std::size_t kPictures = 4;

    LensWish of;
    std::optional<Error> error;
    LensSection section;
    double coc_px = 0;              // of the pixel
    int fine = 1;                   // so many by so many pixels of its disc are one of the picture
    double side_px = 0;             // of the discs in front and behind: their radius
    LensCodes disc, front, behind;  // of the pixel; at its place in front of focus, and behind
    LensCodes strip;                // on the axis, from -60 to +60 px
    LongitudinalAberrationFacts curves;
    double opens_to = 0;       // the least f-number; 0: any
    double pupil_z_mm = 0;     // of the section: where the entrance pupil stands
    double best_focus_mm = 0;  // from the paraxial focus: about where blur is least, by the curves
    std::string words;         // what the lens is
};

class LensBench {
public:
    explicit LensBench(std::function<void()> wake);
    ~LensBench();
    LensBench(const LensBench&) = delete;
    LensBench& operator=(const LensBench&) = delete;

    void make(LensWish wish);  // in place of the last
    std::vector<LensMade> news();
    bool is_idle() const;

private:
    void work();

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable something_;
    std::optional<LensWish> wish_;
    std::vector<LensMade> news_;
    bool busy_ = false, ending_ = false;
    std::thread thread_;
};

// Computes on the calling thread.
LensMade on_bench(const LensWish& wish);
inline constexpr double kStripReach_px = 60;
inline constexpr int kStripDiscs = 13;

}  // namespace petzval::view
