#include "contact_sheet.h"

#include "first_look.h"
#include "thinning.h"

#include <algorithm>
#include <new>
#include <utility>

namespace petzval::view {
namespace {

constexpr int kCell_px = 320;  // at least so wide, where the picture is

SheetCell cell_of(Session& session, const OpenShot& shot, const Camera& camera, const SheetEntry& entry,
                  const DevelopSettings& display, const Control& control) {
    SheetCell cell;
    auto lent = rendered(shot.shot);
    if (!lent) return {0, 0, 0, {}, lent.error().message};
    lent->camera = camera;
    if (entry.f_number > 0) lent->camera.f_number = entry.f_number;
    lent->layers.clear();
    Look look = entry.look;
    look.quality = Quality::Draft;
    look.glare.star_quality = StarQuality::Draft;
    if (look.engine != "gaussian") look.engine = "gather";
    if (const Status done = read_lens_images(look); !done) return {0, 0, 0, {}, done.error().message};
    const int by = std::max(1, shot.shot.colour.width() / kCell_px);
    auto made = first_look(session, *lent, look, by, control);
    if (!made) return {0, 0, 0, {}, made.error().message};
    const Picture small = thinned<Rgba>(made->image, by);
    const auto codes = develop(small, display);
    cell.width = small.width();
    cell.height = small.height();
    cell.rgba.assign(4 * small.size(), 255);
    for (std::size_t i = 0; i < small.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) cell.rgba[4 * i + c] = std::uint8_t(codes[3 * i + c]);
    return cell;
}

}  // namespace

ContactSheet::ContactSheet(std::shared_ptr<Session> session, std::function<void()> wake)
    : session_(std::move(session)), wake_(std::move(wake)) {}

ContactSheet::~ContactSheet() { stop(); }

void ContactSheet::stop() {
    cancelled_ = true;
    if (thread_.joinable()) thread_.join();
    cancelled_ = false;
    const std::lock_guard lock(mutex_);
    done_.clear();
}

void ContactSheet::make(ShotPointer shot, const Camera& camera, std::vector<SheetEntry> entries,
                        const DevelopSettings& display) {
    stop();
    busy_ = true;
    thread_ = std::thread([this, shot = std::move(shot), camera, entries = std::move(entries), display] {
        work(shot, camera, entries, display);
        busy_ = false;
        wake_();
    });
}

std::vector<SheetCell> ContactSheet::news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(done_, {});
}

void ContactSheet::work(const ShotPointer& shot, Camera camera, const std::vector<SheetEntry>& entries,
                        const DevelopSettings& display) {
    const Control control{.cancelled = [this] { return cancelled_.load(std::memory_order_relaxed); }};
    for (std::size_t i = 0; i < entries.size() && !cancelled_; ++i) {
        SheetCell cell;
        try {
            cell = cell_of(*session_, *shot, camera, entries[i], display, control);
        } catch (const std::bad_alloc&) {
            cell.error = "not enough memory";
        }
        cell.entry = i;
        const std::lock_guard lock(mutex_);
        done_.push_back(std::move(cell));
        wake_();
    }
}

}  // namespace petzval::view
