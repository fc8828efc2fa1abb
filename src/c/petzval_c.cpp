// The library behind its C door: handles, structs of any age, errors as a code and a sentence.
#include "petzval/petzval_c.h"

#include "petzval/devices.h"
#include "petzval/session.h"

#include "c/handles.h"
#include "c/lent.h"
#include "c/report_text.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct petzval_session {
    petzval::Session session;
};

struct petzval_report {
    std::string json;
};

namespace {

using namespace petzval;
using petzval::c::check_pictures;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

// Errors: InvalidArgument for a number of threads; those of lent workers.
Result<SessionSettings> settings_of(const petzval_session_settings* given) {
    constexpr int kMostThreads = 1024;
    const petzval_session_settings s = c::taken(given);
    if (s.threads < 0 || s.threads > kMostThreads)
        return Error{ErrorCode::InvalidArgument, "session.threads is " + std::to_string(s.threads) +
                                                     "; 0 (all) to " + std::to_string(kMostThreads)};
    SessionSettings settings;
    settings.threads = s.threads;
    settings.max_memory_bytes = std::size_t(s.max_memory_bytes);
    if (s.kernel_folder) settings.kernel_cache_folder = s.kernel_folder;
    if (s.device) settings.device = s.device;
    auto workers = c::workers_of(s.workers);
    if (!workers) return workers.error();
    settings.workers = std::move(*workers);
    return settings;
}

Control control_of(const petzval_control* given) {
    const petzval_control c = c::taken(given);
    Control control;
    if (c.progress) control.progress = [c](double done) { return c.progress(c.host, done) != 0; };
    if (c.cancelled || c.stop)
        control.cancelled = [c] {
            return (c.stop && *c.stop != 0) || (c.cancelled && c.cancelled(c.host) != 0);
        };
    const Rect region{c.region.x0, c.region.y0, c.region.x1, c.region.y1};
    if (!region.empty()) control.region = region;
    return control;
}

// The lens that the look was given, so that nothing opens it again. Errors: those of Lens::with().
Status lend_lens(const petzval_look* look, DefocusJob& job) {
    if (!look || !look->lens) return Done{};
    auto lens = c::lens_of(*look);
    if (!lens) return lens.error();
    job.opened_lens = std::move(*lens);
    return Done{};
}

petzval_status take_frame(petzval_session* session, const petzval_shot* given, const petzval_look* look,
                          const petzval_control* control, const petzval_pixels* out,
                          petzval_report** report) {
    const auto into = c::colour_view(out, "out");
    if (!into) return fail(into.error());
    const auto compared = c::ComparedShot::compare(given);
    if (!compared) return fail(compared.error());
    const Control how = control_of(control);
    const Rect data = compared->place.data_window, asked = how.region ? how.region->intersected(data) : data;
    if (!asked.empty() && (into->width != asked.width() || into->height != asked.height()))
        return fail(PETZVAL_INVALID_ARGUMENT, how.region
                                                  ? "out must be of the size of what lies in control.region"
                                                  : "out and the shot's colour must be of one size");
    const Look chosen = look ? look->look : Look{};
    if (const Status ok = check_pictures(chosen); !ok) return fail(ok.error());
    c::TakenShot shot;
    if (const Status taken = c::TakenShot::take(*compared, shot); !taken) return fail(taken.error());
    if (const Status ok = lend_lens(look, shot.job); !ok) return fail(ok.error());
    const auto frame = session->session.take(shot.job, chosen, how);
    if (!frame) return fail(frame.error());
    if (report) {
        auto made = std::make_unique<petzval_report>();
        made->json = c::report_text(*frame);
        *report = made.release();
    }
    write_pixels(frame->image, *into);
    return PETZVAL_OK;
}

const char* name_at(const std::vector<std::string>& names, int index) {
    return index >= 0 && std::size_t(index) < names.size() ? names[std::size_t(index)].c_str() : nullptr;
}

}  // namespace

petzval_status petzval_session_open(const petzval_session_settings* settings, petzval_session** session) {
    if (!session) return missing("session");
    *session = nullptr;
    return guarded([&] {
        auto taken = settings_of(settings);
        if (!taken) return fail(taken.error());
        if (const Status there = check_device(taken->device); !there) return fail(there.error());
        *session = new petzval_session{Session(std::move(*taken))};
        return PETZVAL_OK;
    });
}

void petzval_session_close(petzval_session* session) { delete session; }

petzval_status petzval_session_usage(const petzval_session* session, petzval_usage* usage) {
    if (!session) return missing("session");
    if (!usage) return missing("usage");
    return guarded([&] {
        const SessionUsage used = session->session.usage();
        const petzval_usage whole{usage->size, used.kept_bytes, used.lenses};
        std::memcpy(usage, &whole, std::min(usage->size, sizeof whole));
        return PETZVAL_OK;
    });
}

petzval_status petzval_session_trim(petzval_session* session, uint64_t bytes) {
    if (!session) return missing("session");
    return guarded([&] {
        session->session.trim(std::size_t(bytes));
        return PETZVAL_OK;
    });
}

const char* petzval_engine_name(int index) {
    static const std::vector<std::string> names = engine_names();
    return name_at(names, index);
}

const char* petzval_device_name(int index) {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> found;
        for (const petzval::DeviceFacts& device : petzval::devices()) found.push_back(device.name);
        return found;
    }();
    return name_at(names, index);
}

petzval_status petzval_defocus(petzval_session* session, const petzval_shot* shot, const petzval_look* look,
                               const petzval_control* control, const petzval_pixels* out,
                               petzval_report** report) {
    if (report) *report = nullptr;
    if (!session) return missing("session");
    return guarded([&] { return take_frame(session, shot, look, control, out, report); });
}

petzval_status petzval_region_margin_px(petzval_session* session, const petzval_shot* given,
                                        const petzval_look* look, int* margin_px) {
    if (!session) return missing("session");
    if (!margin_px) return missing("margin_px");
    return guarded([&] {
        const auto compared = c::ComparedShot::compare(given);
        if (!compared) return fail(compared.error());
        c::TakenShot shot;
        if (const Status taken = c::TakenShot::take(*compared, shot); !taken) return fail(taken.error());
        if (const Status ok = lend_lens(look, shot.job); !ok) return fail(ok.error());
        const auto margin =
            session->session.region_margin_px(with_look(shot.job, look ? look->look : Look{}));
        if (!margin) return fail(margin.error());
        *margin_px = *margin;
        return PETZVAL_OK;
    });
}

const char* petzval_report_json(const petzval_report* report) { return report ? report->json.c_str() : ""; }

void petzval_report_close(petzval_report* report) { delete report; }
