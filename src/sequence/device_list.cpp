#include "petzval/reports/devices.h"

#include "records/record_json.h"

namespace petzval {

using records::Json;

std::string device_list_text(const std::vector<DeviceFacts>& devices, const std::string& no_gpu) {
    std::string text;
    for (const DeviceFacts& device : devices) {
        text += device.name + "  " + device.title;
        if (device.is_software) text += ", a software driver";
        if (!device.lacks.empty()) text += "; missing: " + device.lacks;
        text += "\n";
    }
    return no_gpu.empty() ? text : text + "no gpu: " + no_gpu + "\n";
}

std::string device_list_record(const std::vector<DeviceFacts>& devices, const std::string& no_gpu) {
    const auto given = [](const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); };
    Json record = Json::parse(empty_record("devices"));
    record["devices"] = Json::array();
    for (const DeviceFacts& device : devices)
        record["devices"].push_back({{"name", device.name},
                                     {"title", device.title},
                                     {"software", device.is_software},
                                     {"lacks", given(device.lacks)}});
    record["no_gpu"] = given(no_gpu);
    return records::as_text(record);
}

}  // namespace petzval
