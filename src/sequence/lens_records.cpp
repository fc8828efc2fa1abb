#include "petzval/lens_json.h"
#include "petzval/reports/lenses.h"

#include "records/record_json.h"

namespace petzval {
namespace {

using records::Json;

Json json_of(const LensFacts& facts) { return Json::parse(record_of_json(lens_facts_json(facts))); }

Json record_of(const std::string& verb, const std::string& input) {
    Json record = Json::parse(empty_record(verb));
    record["input"] = input;
    return record;
}

std::string finished(Json record, double seconds) {
    record["seconds"]["compute"] = record["seconds"]["total"] = seconds;
    record["peak_memory_bytes"] = peak_memory_bytes();
    return records::as_text(record);
}

}  // namespace

std::string lens_list_record(const std::vector<LensSummary>& lenses) {
    Json record = Json::parse(empty_record("lens list"));
    record["lenses"] = Json::parse(record_of_json(lens_list_json(lenses)));
    return records::as_text(record);
}

std::string lens_show_record(const LensFacts& facts, const std::string& input, double seconds) {
    Json record = record_of("lens show", input);
    record.update(json_of(facts));
    return finished(std::move(record), seconds);
}

std::string lens_check_record(const LensFacts& facts, const std::string& input, double seconds) {
    Json record = record_of("lens check", input);
    const Json all = json_of(facts);
    for (const char* key :
         {"lens", "format", "warnings", "doubts", "printed_efl_mm", "printed_f_number", "efl_mm", "f_number"})
        record[key] = all.at(key);
    return finished(std::move(record), seconds);
}

}  // namespace petzval
