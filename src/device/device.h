// A device draws what engines plan and lights and develops pictures that it drew. A second device is a folder
// with the same file names.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "base/progress.h"
#include "device/canvas.h"
#include "device/kernels.h"
#include "device/memory.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace petzval::colour {
struct DevelopPlan;
}
namespace petzval::engine {
struct GatherPlan;
struct GaussianPlan;
struct LightsPlan;
struct RealtimePlan;
struct ScatterPlan;
}  // namespace petzval::engine
namespace petzval::glare {
struct GlarePlan;
}

namespace petzval::device {

// Kernels of one set, ready for one device. They stay alive with it.
class Atlas {
public:
    Atlas() = default;
    virtual ~Atlas() = default;
    Atlas(const Atlas&) = delete;
    Atlas& operator=(const Atlas&) = delete;
};

// Told the name of each pass when it is done, by devices that do one after the other; may be empty.
using Passed = std::function<void(const char* pass)>;

// Settings of one piece of work.
struct Control {
    Workers& workers;
    Progress& progress;
    double share = 0;  // of the whole progress
    Passed passed = {};
};

// The work that drawing took, counted from plan and kernels; taps clipped at the edges of tiles count in
// full. docs/reference/report.md ("The report") lists the counts.
struct Work {
    std::uint64_t bytes = 0, multiply_adds = 0;
    // Kernels of `taps` pixels in all, added to sums: RGBA weights and sums read, sums written.
    Work& operator+=(Work other) {
        bytes += other.bytes;
        multiply_adds += other.multiply_adds;
        return *this;
    }
    static Work of_taps(std::size_t taps) { return {48 * taps, 4 * taps}; }
};

// Any of its verbs may end with Failed (device/failure.h) or with Cancelled.
class Device {
public:
    Device() = default;
    virtual ~Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    virtual const char* name() const = 0;

    // One that this device draws on, and can hand from verb to verb without its coming home. memory: where it
    // comes home to.
    virtual std::unique_ptr<Canvas> canvas(Picture memory) const = 0;

    // Makes what is missing of a set, in parallel, before anything is drawn with it. Kernels are kept in
    // `memory`, under the name of their source. Incomplete once cancelled.
    virtual std::shared_ptr<const Atlas> atlas(const KernelSource& source, const KernelSet& set,
                                               Memory& memory, const Control& control) const = 0;

    // Writes the plan's rows of `out`, the whole frame. `atlas` is that of the plan's kernels.
    virtual Work composite(const engine::ScatterPlan& plan, const Atlas& atlas, Target out,
                           const Control& control) const = 0;
    // Writes the plan's tiles of `out`, the whole frame.
    virtual void gather(const engine::GatherPlan& plan, const Atlas& atlas, Target out,
                        const Control& control) const = 0;
    // Writes all of `out`.
    virtual void mix(const engine::GaussianPlan& plan, Target out, const Control& control) const = 0;
    // Writes all of `out`. The CPU has no pass for real time and says so.
    virtual void draw_realtime(const engine::RealtimePlan& plan, Target out,
                               const Control& control) const = 0;
    // Memory of this process that draw_realtime() takes for a picture of so many pixels, besides the plan and
    // `out`: the driver's, and of a driver in software the device's memory too.
    virtual std::size_t realtime_bytes(std::size_t /*pixels*/) const { return 0; }
    // Adds to the plan's rows of `out`, the whole frame.
    virtual Work add_lights(const engine::LightsPlan& plan, const Atlas& atlas, Target out,
                            const Control& control) const = 0;
    // Moves the plan's light within a picture. False: this device cannot, and nothing was done.
    virtual bool add_glare(const glare::GlarePlan& plan, Canvas& picture, Workers& workers,
                           const Passed& passed) const = 0;
    // The part of a picture's light above a threshold, in host memory. Empty: this device cannot compute it.
    virtual Picture highlights(Canvas& picture, float threshold, Workers& workers) const = 0;
    // The plan's part of a picture as codes of a display (petzval/develop.h); only the codes are copied to
    // the host. Empty: this device cannot compute them, or the picture is in host memory.
    virtual std::vector<std::uint16_t> develop(const colour::DevelopPlan& plan, Canvas& picture,
                                               Workers& workers) const = 0;
};

}  // namespace petzval::device
