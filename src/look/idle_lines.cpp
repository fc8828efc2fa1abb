#include "petzval/look_check.h"
#include "petzval/reports/words.h"

#include <algorithm>
#include <utility>

namespace petzval {

std::vector<std::string> idle_lines(const std::string& file, const std::vector<Error>& idle) {
    std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
    for (const Error& one : idle) {
        const std::string why = one.message.substr(one.field.size() + std::string(" has").size());
        auto found = std::find_if(by_reason.begin(), by_reason.end(),
                                  [&](const auto& known) { return known.first == why; });
        if (found == by_reason.end()) found = by_reason.insert(found, {why, {}});
        found->second.push_back(one.field);
    }
    std::vector<std::string> lines;
    for (const auto& [why, fields] : by_reason) {
        std::string line = file + ": " + listed(fields);
        lines.push_back(line.append(fields.size() > 1 ? " have" : " has").append(why));
    }
    return lines;
}

}  // namespace petzval
