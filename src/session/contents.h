// The contents of a session.
#pragma once

#include "petzval/session.h"

#include "base/cancel.h"
#include "base/ended.h"
#include "base/parallel.h"
#include "engine/samples/kept_surfaces.h"
#include "glare/kept_stars.h"
#include "session/blurred.h"
#include "session/mounted_lens.h"
#include "session/open_device.h"
#include "session/request.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace petzval {

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
    engine::KeptSurfaces surfaces;                 // the same

    std::size_t most_kept_bytes() const {
        constexpr std::size_t kUnlimited = std::size_t(1) << 30;
        return settings.max_memory_bytes > 0 ? settings.max_memory_bytes / 8 : kUnlimited;
    }

    // The blur of one frame. region: the part of its data window that is wanted. spare: as
    // FrameStages::begin() has it; null: none. Errors: those of Session::defocus(). Throws what ends a frame
    // (base/ended.h). Requires: check_request(), the lens is open.
    Result<Blurred> blur(const FrameRequest& request, const std::optional<Rect>& region, Picture* spare,
                         Progress& progress);

    // The largest radius of a frame, and how far its light lands. Errors: those of Session::defocus().
    struct Reach {
        double radius_px = 0, light_px = 0;
    };
    Result<Reach> reach(const Rendered& rendered, const Look& look, const Control& control);

    // Runs body(), which gives a Result or a Status, for a frame of these workers. What ends it early comes
    // back as an error.
    template <typename Body>
    static auto guarded(CancellableWorkers& workers, const Body& body) {
        using Made = std::invoke_result_t<Body>;
        const WorksFor these(workers);
        try {
            return body();
        } catch (const Ended& ended) {
            return Made(ended.error);
        }
    }

    // Errors: those of open_device(). Drivers take long to start: others who open the same device wait,
    // usage() and trim() do not.
    Result<std::shared_ptr<const device::Device>> opened_device() {
        const std::lock_guard starting(opening);
        if (device) return device;
        auto opened = open_device(settings.device);
        if (opened) device = *opened;
        return opened;
    }

    // Errors: those of the lens.
    Result<std::shared_ptr<MountedLens>> lens_for(const FrameRequest& request) {
        const std::string key = MountedLens::key_of(request);
        if (!key.empty()) {
            const std::lock_guard lock(mutex);
            for (auto i = lenses.begin(); i != lenses.end(); ++i) {
                if (i->first != key) continue;
                lenses.splice(lenses.begin(), lenses, i);
                return i->second;
            }
        }
        auto made = MountedLens::make(request, most_kept_bytes());
        if (!made || key.empty()) return made;
        const std::lock_guard lock(mutex);
        lenses.emplace_front(key, *made);
        return made;
    }

    // Those of the lenses, each once: frames of other cameras and looks share them. Requires: `mutex` is
    // held.
    std::vector<std::shared_ptr<kernel::LastRays>> rays_of_lenses() const {
        std::vector<std::shared_ptr<kernel::LastRays>> all;
        for (const auto& [key, lens] : lenses)
            if (std::find(all.begin(), all.end(), lens->rays) == all.end()) all.push_back(lens->rays);
        return all;
    }

    // Lenses that hold more than stars, surfaces and other lenses leave them lose their kernels first, then
    // go.
    void trim(std::size_t bytes) {
        // Tables of a lens besides its kernels: up to 7 MiB.
        constexpr std::size_t kMostLenses = 8, kTables = std::size_t(6) << 20;
        const std::size_t most = bytes > 0 ? std::clamp<std::size_t>(bytes / kTables, 1, kMostLenses) : 0;
        const std::lock_guard lock(mutex);
        stars.trim(bytes);
        std::size_t held = stars.bytes();
        surfaces.trim(bytes - std::min(bytes, held));
        held += surfaces.bytes();
        for (auto& [key, lens] : lenses) {
            lens->trim(bytes - std::min(bytes, held));
            held += lens->bytes();
        }
        for (const auto& rays : rays_of_lenses()) {
            rays->trim(bytes - std::min(bytes, held));
            held += rays->bytes();
        }
        while (lenses.size() > most) lenses.pop_back();
    }

    SessionUsage usage() const {
        const std::lock_guard lock(mutex);
        SessionUsage usage;
        for (const auto& [key, lens] : lenses) usage.kept_bytes += lens->bytes();
        for (const auto& rays : rays_of_lenses()) usage.kept_bytes += rays->bytes();
        usage.kept_bytes += stars.bytes() + surfaces.bytes();
        usage.lenses = int(lenses.size());
        return usage;
    }
};

}  // namespace petzval
