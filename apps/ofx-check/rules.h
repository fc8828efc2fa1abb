// The rules that plug-ins are checked against, and the findings.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace ofx_check {

struct Rule {
    const char* name;
    const char* page;  // of the specification's reference manual
    const char* says;
};
std::span<const Rule> rules();

// Findings go to the descriptor `to` as lines; a check runs in a separate process.
void report_to(int to);
void held(std::string_view rule);  // it was tried and, so far, held
void broken(std::string_view rule, const std::string& why);
void not_tried(std::string_view rule, const std::string& why);
// Until the next call, a crash or a hang breaks this rule as well.
void trying(std::string_view rule);

// Findings of all checks, by rule.
struct Outcome {
    bool tried = false, is_broken = false;
    std::string why;    // of the first break, or of why it was not tried
    std::string check;  // that broke it first
};
using Outcomes = std::map<std::string, Outcome, std::less<>>;
// One line as the functions above write it.
void take(Outcomes& outcomes, const std::string& line, const std::string& check);
// The rule of a line that trying() wrote; empty for other lines.
std::string tried_rule(const std::string& line);

}  // namespace ofx_check
