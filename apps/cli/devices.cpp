// petzval devices: what defocus can draw with.
#include "petzval/devices.h"

#include "console/report.h"
#include "flags/run_flags.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

Status list_devices(const RunFlags& run) {
    std::string text;
    Json list = Json::array();
    for (const DeviceFacts& device : devices()) {
        text += device.name + "  " + printable(device.title) +
                (device.is_software ? ", a software driver" : "") +
                (device.lacks.empty() ? "" : "; missing: " + device.lacks) + "\n";
        list.push_back({{"name", device.name},
                        {"title", device.title},
                        {"software", device.is_software},
                        {"lacks", device.lacks.empty() ? Json(nullptr) : Json(device.lacks)}});
    }
    const std::string missing = why_no_gpu();
    if (!missing.empty()) text += "no gpu: " + missing + "\n";
    Json report = new_report("devices");
    report["devices"] = list;
    report["no_gpu"] = missing.empty() ? Json(nullptr) : Json(missing);
    return tell(text, report, run.json);
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
