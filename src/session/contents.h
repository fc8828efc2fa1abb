// What a session holds, and a frame as it is made.
#pragma once

#include "petzval/session.h"

#include "base/cancel.h"
#include "base/parallel.h"
#include "device/failure.h"
#include "glare/kept_stars.h"
#include "session/mounted_lens.h"
#include "session/open_device.h"

#include <algorithm>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace petzval {

// What is done to a picture before it comes home from what drew it; null afterwards: nobody needs it there.
using Finish = std::function<Status(std::shared_ptr<device::Canvas>&)>;

// Lenses that frames used, the last one first. Frames hold what they use, so that it may be let go of any
// time.
struct Session::Contents {
    explicit Contents(SessionSettings s) : settings(std::move(s)) {
        if (!settings.workers) settings.workers = workers_of(settings.threads, nullptr);
    }

    SessionSettings settings;
    mutable std::mutex mutex;  // of `lenses`
    std::list<std::pair<std::string, std::shared_ptr<MountedLens>>> lenses;
    std::mutex opening;                            // of `device`
    std::shared_ptr<const device::Device> device;  // null: not opened yet
    glare::KeptStars stars;                        // with a lock of its own

    std::size_t most_kept_bytes() const {
        constexpr std::size_t kUnlimited = std::size_t(1) << 30;
        return settings.max_memory_bytes > 0 ? settings.max_memory_bytes / 8 : kUnlimited;
    }

    // A defocus alone, and what is done to its picture last, if not empty. Errors: those of
    // Session::defocus() and of `last`. Throws Cancelled.
    Result<DefocusReport> defocus(const DefocusJob& given, const std::optional<Rect>& region,
                                  Progress& progress, CancellableWorkers& workers, const Finish& last = {});

    // The largest radius of a frame, and how far its light lands. Errors: those of Session::defocus().
    struct Reach {
        double radius_px = 0, light_px = 0;
    };
    Result<Reach> reach(const DefocusJob& job);

    // Runs body(progress, workers), which gives a Result, for one frame.
    template <typename Body>
    auto unless_cancelled(const Control& control, const Body& body) {
        using Made = std::invoke_result_t<Body, Progress&, CancellableWorkers&>;
        Progress progress(control.progress, control.cancelled);
        CancellableWorkers cancellable(*settings.workers, progress);
        const WorksFor these(cancellable);
        try {
            return body(progress, cancellable);
        } catch (const Cancelled&) {
            return Made(Error{ErrorCode::Cancelled, "cancelled"});
        } catch (const device::Failed& failed) {
            return Made(failed.error);
        }
    }

    // Errors: those of open_device(). Drivers take long to start: whoever asks for the same device waits,
    // usage() and trim() do not.
    Result<std::shared_ptr<const device::Device>> opened_device() {
        const std::lock_guard starting(opening);
        if (device) return device;
        auto opened = open_device(settings.device);
        if (opened) device = *opened;
        return opened;
    }

    // Errors: those of the lens.
    Result<std::shared_ptr<MountedLens>> lens_for(const DefocusJob& job) {
        const std::string key = MountedLens::key_of(job);
        if (!key.empty()) {
            const std::lock_guard lock(mutex);
            for (auto i = lenses.begin(); i != lenses.end(); ++i) {
                if (i->first != key) continue;
                lenses.splice(lenses.begin(), lenses, i);
                return i->second;
            }
        }
        auto made = MountedLens::make(job, most_kept_bytes());
        if (!made || key.empty()) return made;
        const std::lock_guard lock(mutex);
        lenses.emplace_front(key, *made);
        return made;
    }

    // Of lenses that hold more than stars and the others leave them: first their kernels go, then they.
    void trim(std::size_t bytes) {
        constexpr std::size_t kMostLenses = 8;  // each holds tables besides its kernels
        const std::lock_guard lock(mutex);
        stars.trim(bytes);
        std::size_t held = stars.bytes();
        for (auto& [key, lens] : lenses) {
            lens->trim(bytes - std::min(bytes, held));
            held += lens->bytes();
        }
        while (lenses.size() > (bytes > 0 ? kMostLenses : 0)) lenses.pop_back();
    }

    SessionUsage usage() const {
        const std::lock_guard lock(mutex);
        SessionUsage usage;
        for (const auto& [key, lens] : lenses) usage.kept_bytes += lens->bytes();
        usage.kept_bytes += stars.bytes();
        usage.lenses = int(lenses.size());
        return usage;
    }
};

}  // namespace petzval
