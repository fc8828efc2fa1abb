// Sessions, engines and devices behind the C API.
#include "petzval/devices.h"
#include "petzval/petzval_c.h"
#include "petzval/session.h"

#include "c/handles.h"
#include "c/lent.h"
#include "c/session_handle.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

const char* name_at(const std::vector<std::string>& names, int index) {
    return index >= 0 && std::size_t(index) < names.size() ? names[std::size_t(index)].c_str() : nullptr;
}

}  // namespace

petzval_status petzval_session_open(const petzval_session_settings* settings, petzval_session** session) {
    if (!session) return missing("session");
    *session = nullptr;
    return guarded([&] {
        auto taken = c::session_settings_of(settings);
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
