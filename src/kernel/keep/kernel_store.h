// Kernels kept on disk between runs.
//
// A folder holds one folder per lens, named by everything that decides its kernels (lens_key(): lens,
// options, camera, sizes, and the program's build). In it lie segments: each is written once, by one run,
// under a name of its own and renamed into place, so processes never disturb each other. A segment that is
// damaged or unreadable in any way, of another lens, or holds what no lens can have, is as if it were not
// there. What is read back is what was written, bit for bit. New folders are this user's alone; one that
// others can write to is not used, for hashes do not hold against malice.
#pragma once

#include "kernel/model/lens_model.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace petzval::kernel {

// The kept kernels of one lens. Threads may use it at once. Never an error: without a usable folder it holds
// nothing.
class KernelStore {
public:
    // max_bytes: of all lenses together; the segments that were not used longest go first.
    KernelStore(std::string folder, const std::string& lens_key, std::size_t max_bytes);
    ~KernelStore();  // writes what is new
    KernelStore(const KernelStore&) = delete;
    KernelStore& operator=(const KernelStore&) = delete;

    struct Key {
        int level = 0;  // pixels 2^level times as wide
        double coc_radius_px = 0, field_x = 0, field_y = 0;
        friend auto operator<=>(const Key&, const Key&) = default;  // NOLINT(modernize-use-nullptr): not one
    };
    std::optional<PointSpread> find(const Key& key) const;
    // Keeps a kernel, unless the kernels of this run would then take more than an eighth of the limit.
    void add(const Key& key, const PointSpread& kernel);

    std::size_t kernels_found() const { return found_; }
    // One line for the user where the folder is not used because others may write to it; else empty.
    const std::string& warning() const { return warning_; }

private:
    struct Segment;
    struct Place {
        const Segment* segment = nullptr;
        std::size_t record = 0;
    };
    void open_segments();
    void write_pending();

    std::string folder_, lens_folder_, lens_key_, warning_;
    std::size_t max_bytes_;
    std::vector<std::unique_ptr<const Segment>> segments_;
    std::map<Key, Place> places_;
    mutable std::atomic<std::size_t> found_{0};
    std::mutex mutex_;  // of all below
    std::vector<std::pair<Key, PointSpread>> pending_;
    std::size_t pending_bytes_ = 0, written_bytes_ = 0;
};

// The lens, with kernels that were made before taken from `store` and new ones given to it.
std::unique_ptr<const LensModel> kept(std::unique_ptr<const LensModel> lens,
                                      std::shared_ptr<KernelStore> store, int level);

}  // namespace petzval::kernel
