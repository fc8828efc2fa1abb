#include "console/report.h"

#include "petzval/look_json.h"

#include "flags/fields.h"
#include "output.h"

namespace petzval::cli {

Json new_report(const std::string& verb) { return Json::parse(empty_record(verb)); }

Json json_of(const std::string& text) { return Json::parse(record_of_json(text)); }

Json look_json(const Look& look) { return Json::parse(look_to_json(look)); }

Json finished(Json report, const Stopwatch& watch) {
    report["seconds"]["total"] = watch.seconds();
    report["peak_memory_bytes"] = peak_memory_bytes();
    return report;
}

std::string report_text(const Json& report, int indent) {
    // A file name that is not UTF-8 has U+FFFD in it afterwards.
    const std::string text = report.dump(-1, ' ', false, Json::error_handler_t::replace);
    return finished_record(text, indent, [](const std::string& line) { return in_flags(line); });
}

Status write_report(const Json& report, const std::string& path) {
    return write_text(path, report_text(report));
}

Status write_record(const std::string& record, const std::string& json) {
    return record.empty() || json.empty() ? Status(Done{}) : write_report(Json::parse(record), json);
}

Status tell(const std::string& text, const Json& report, const std::string& json) {
    if (json != "-")
        if (Status said = write_text("-", text); !said) return said;
    return json.empty() ? Status(Done{}) : write_report(report, json);
}

}  // namespace petzval::cli
