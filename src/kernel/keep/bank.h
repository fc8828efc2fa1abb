// A bank of kernels: an engine asks for the kernel of a defocus at a place, and the work is done once.
//
// Signed radii are rounded to steps of `least_step_px` near focus and of `relative_step` beyond, places to
// the middle of their image cell. What a key holds depends on the key alone, so the bits are the same for any
// thread count and order of asking, also when a kernel was dropped for memory and is made again.
#pragma once

#include "petzval/workers.h"

#include "kernel/keep/kernel_cache.h"
#include "kernel/model/lens_model.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace petzval::kernel {

struct BankOptions {
    int columns = 9, rows = 6;  // image cells; one cell for lenses that do not vary over the field
    // > 0: cells are halved for large radii until a rim that travels by the kernel's reach over the half
    // diagonal moves by no more than this from cell to cell. 0: cells are the same for every radius.
    double largest_rim_step_px = 0;
    double aspect = 16.0 / 9;     // width / height of the picture, to find cells from field positions; > 0
    double relative_step = 0.03;  // > 0
    double least_step_px = 0.25;  // > 0
    std::size_t max_bytes = std::size_t(512) << 20;  // kernels kept; the least recently used go first
};

class KernelBank {
public:
    // `lens` outlives the bank.
    explicit KernelBank(const LensModel& lens, const BankOptions& options = {});

    // Thread-safe. Of two threads that ask for the same new kernel one makes it and the other waits for it.
    // The kernel stays alive as long as the caller holds it.
    std::shared_ptr<const PointSpread> kernel(double coc_radius_px, FieldPosition field) const {
        return kernel(place(coc_radius_px, field));
    }
    // The properties that identify a kernel: asks with the same place share one kernel.
    struct Place {
        int step = 0, cell = 0;
    };
    Place place(double coc_radius_px, FieldPosition field) const {
        const int step = step_of(coc_radius_px);
        return {step, cell_of(cells_of(step), field)};
    }
    double radius_px(Place place) const { return radius_of(place.step); }
    FieldPosition middle(Place place) const { return middle_of(cells_of(place.step), place.cell); }
    std::shared_ptr<const PointSpread> kernel(Place place) const { return kernel_of(place.step, place.cell); }

    // Makes all kernels between two signed radii, for every cell, as far as the memory limit allows.
    void prepare(double least_coc_px, double largest_coc_px, Workers& workers) const;

    double rounded_radius_px(double coc_radius_px) const { return radius_of(step_of(coc_radius_px)); }
    FieldPosition cell_middle(FieldPosition field, double coc_radius_px = 0) const {
        const Cells cells = cells_of(step_of(coc_radius_px));
        return middle_of(cells, cell_of(cells, field));
    }
    std::size_t kernels_held() const { return cache_.kernels(); }
    std::size_t bytes_held() const { return cache_.bytes(); }

private:
    int step_of(double coc_radius_px) const;
    double radius_of(int step) const;
    struct Cells {
        int columns = 1, rows = 1;
    };
    Cells cells_of(int step) const;
    int cell_of(const Cells& cells, FieldPosition field) const;
    FieldPosition middle_of(const Cells& cells, int cell) const;
    std::shared_ptr<const PointSpread> kernel_of(int step, int cell) const;
    PointSpread made(int step, int cell) const;

    const LensModel& lens_;
    BankOptions options_;
    int linear_steps_;  // steps of even width on either side of focus; beyond, each is `relative_step` wider
    double linear_end_px_;
    double half_width_, half_height_;  // of the picture, in half diagonals
    mutable KernelCache<std::uint64_t> cache_;
};

}  // namespace petzval::kernel
