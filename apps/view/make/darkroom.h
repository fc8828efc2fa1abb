// The thread that turns light and numbers into codes of a display: what is seen of them, at the size at which
// it is seen.
#pragma once

#include "petzval/develop.h"
#include "petzval/engine_report.h"
#include "petzval/image.h"
#include "petzval/shot_run.h"

#include "state.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace petzval::view {

// Display of a plane's numbers.
enum class Numbers {
    Light,    // none: it is a picture
    Radii,    // near blue, far orange, black in focus; as far as the largest
    Overlay,  // the same over a picture, in focus white
    Depth,    // near bright, far dark: 1/depth
};

// Display codes that arrived instead of light, three per pixel.
struct DraftCodes {
    int width = 0, height = 0;
    std::vector<std::uint16_t> rgb;
};

struct Negative {
    std::shared_ptr<const Picture> picture;
    std::shared_ptr<const DraftCodes> codes;  // in its place: of all of the area, reduced already
    std::shared_ptr<const Plane> plane;
    std::shared_ptr<const std::vector<Panel>> panels;  // some of which may hold numbers; may be null
    Rect area;                                         // where its pixels lie
    Rect part;                                         // which of them are wanted, in the same pixels
    int reduce = 1;                                    // so many by so many pixels become one
    Numbers numbers = Numbers::Light;
    double permissible_radius_px = 1;
    DevelopSettings develop;
    bool ocio = false;
    Channel channel = Channel::Colour;

    bool operator==(const Negative& other) const;
};

struct Print {
    int target = 0;
    Negative of;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // rows from the top
    std::optional<Error> error;
};

class Darkroom {
public:
    using ToDisplay = decltype(ShotRunHost::to_display);
    static constexpr std::size_t kTargets = 5;

    Darkroom(ToDisplay to_display, std::function<void()> wake);
    ~Darkroom();
    Darkroom(const Darkroom&) = delete;
    Darkroom& operator=(const Darkroom&) = delete;

    // Requests a print; replaces the earlier request for this target (0…kTargets - 1).
    void print(int target, Negative negative);
    std::vector<Print> prints();
    bool is_idle() const;

private:
    void work();

    ToDisplay to_display_;
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable something_;
    std::array<std::optional<Negative>, kTargets> waiting_;
    std::vector<Print> done_;
    bool busy_ = false, ending_ = false;
    std::thread thread_;
};

// Develops on the calling thread.
Print developed(const Negative& negative, const Darkroom::ToDisplay& to_display);

}  // namespace petzval::view
