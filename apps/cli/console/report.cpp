#include "console/report.h"

#include "flags/fields.h"
#include "output.h"

namespace petzval::cli {

Status write_record(const std::string& record, const std::string& json) {
    if (record.empty() || json.empty()) return Done{};
    return write_text(json, finished_record(record, 2, [](const auto& line) { return in_flags(line); }));
}

Status tell(const std::string& text, const std::string& record, const std::string& json) {
    if (json != "-")
        if (Status said = write_text("-", text); !said) return said;
    return write_record(record, json);
}

}  // namespace petzval::cli
