// Runs over the frames of a shot behind the C API.
#include "petzval/devices.h"
#include "petzval/petzval_run_c.h"
#include "petzval/shot_run.h"

#include "c/handles.h"
#include "c/lent.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

struct petzval_files_run {
    petzval::Session session;
    std::unique_ptr<petzval::ShotRun> run;  // its frames use the session, which outlives it
    bool is_planned = false;
};

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

const char* name_of(FrameRecord::State state) {
    switch (state) {
        case FrameRecord::State::Made:
            return "made";
        case FrameRecord::State::Kept:
            return "kept";
        case FrameRecord::State::Black:
            return "black";
        case FrameRecord::State::Failed:
            return "failed";
    }
    return "";
}

ShotRunHost host_of(const petzval_run_host* given) {
    const petzval_run_host h = c::taken(given);
    ShotRunHost host;
    if (h.frame_done)
        host.frame_done = [h](const FrameRecord& done) {
            return h.frame_done(h.host, done.frame, name_of(done.state), done.why.c_str(),
                                done.record.c_str()) != 0;
        };
    if (h.stop) {
        host.cancelled = [h] { return *h.stop != 0; };
        host.frame_progress = [h](double) { return *h.stop == 0; };
    }
    return host;
}

petzval_status give(const std::vector<int>& from, const int** frames, uint64_t* count) {
    *frames = from.data();
    *count = from.size();
    return PETZVAL_OK;
}

}  // namespace

petzval_status petzval_files_run_open(const petzval_session_settings* given, const char* json,
                                      const petzval_run_host* host, petzval_files_run** run) {
    if (!run) return missing("run");
    *run = nullptr;
    if (!json) return missing("json");
    return guarded([&] {
        auto session = c::session_settings_of(given);
        if (!session) return fail(session.error());
        if (const Status there = check_device(session->device); !there) return fail(there.error());
        auto settings = shot_run_from_json(json);
        if (!settings) return fail(settings.error());
        std::unique_ptr<petzval_files_run> made(new petzval_files_run{Session(std::move(*session)), nullptr});
        made->run = std::make_unique<ShotRun>(made->session, std::move(*settings), host_of(host));
        *run = made.release();
        return PETZVAL_OK;
    });
}

petzval_status petzval_files_run_plan(petzval_files_run* run) {
    if (!run) return missing("run");
    return guarded([&] {
        if (run->is_planned) return PETZVAL_OK;
        if (const Status planned = run->run->plan(); !planned) return fail(planned.error());
        run->is_planned = true;
        return PETZVAL_OK;
    });
}

petzval_status petzval_files_run_frames(const petzval_files_run* run, const int** frames, uint64_t* count) {
    if (!run) return missing("run");
    if (!frames || !count) return missing("frames or count");
    return guarded([&] { return give(run->run->frames(), frames, count); });
}

petzval_status petzval_files_run_all(petzval_files_run* run) {
    if (!run) return missing("run");
    return guarded([&] {
        const Status done = run->run->run();
        run->is_planned = true;
        return done ? PETZVAL_OK : fail(done.error());
    });
}

petzval_status petzval_files_run_failed(const petzval_files_run* run, const int** frames, uint64_t* count) {
    if (!run) return missing("run");
    if (!frames || !count) return missing("frames or count");
    return guarded([&] { return give(run->run->failed(), frames, count); });
}

void petzval_files_run_close(petzval_files_run* run) { delete run; }
