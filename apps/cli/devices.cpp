// petzval devices: what defocus can draw with.
#include "petzval/reports/devices.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/run_flags.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

Status list_devices(const RunFlags& run) {
    const auto found = devices();
    const std::string no_gpu = why_no_gpu();
    return tell(printable(device_list_text(found, no_gpu)), device_list_record(found, no_gpu), run.json);
}

}  // namespace

void add_devices(Verb& program, Action& chosen) {
    Verb& verb =
        add_verb(program, "devices", "list the devices that defocus can draw with", "petzval devices");
    const auto run = std::make_shared<RunFlags>();
    run->add_json_to(verb);
    run->add_log_to(verb, false);
    when_typed(verb, [run, &chosen] {
        run->apply();
        chosen = [run] { return list_devices(*run); };
    });
}

}  // namespace petzval::cli
