// ofx-check: runs an OpenFX plug-in through the rules of the specification, or renders a picture with it.
#include "checks.h"
#include "child.h"
#include "render_verb.h"
#include "rules.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace ofx_check;

constexpr const char* kUsage =
    "usage: ofx-check [options] BUNDLE             check NAME.ofx.bundle, one line a rule\n"
    "       ofx-check render [options] BUNDLE -o OUT.exr --clip NAME=FILE.exr[:CHANNEL] …\n"
    "       ofx-check --rules                      list the rules with their page of the specification\n"
    "\n"
    "  --plugin ID          the plug-in of that identifier, instead of the first\n"
    "  --param NAME=VALUE   value of a parameter: numbers with commas, the words of a menu, text; "
    "repeatable\n"
    "  --edit NAME=VALUE    render: a value that the user gives, after all --param; repeatable, in order\n"
    "  --host NAME          name that this host gives itself (default petzval.ofx-check)\n"
    "  --size WxH           size of the test pictures (default 96x64)\n"
    "  --timeout S          seconds that one check may take (default 60)\n"
    "  --check NAME         run this check alone; repeatable\n"
    "  --checks             list the checks\n"
    "  --context NAME       render: general or filter (default: the first that the plug-in names)\n"
    "  --alpha unpremultiplied\n"
    "                       render: this host keeps colour unpremultiplied in all clips; files stay "
    "premultiplied\n"
    "  --time N, --scale S  render: frame (default 1) and render scale (default 1)\n"
    "\n"
    "exit status: 0 no rule is broken, 1 some are, 2 the command or the bundle cannot be used\n";

int refuse(const std::string& why) {
    std::fprintf(stderr, "ofx-check: %s\n", why.c_str());
    return 2;
}

struct CommandLine {
    Setup setup;
    RenderJob job;
    double timeout_s = 60;
    std::vector<std::string> only, bundles;
    std::string problem;
};

bool is_listed(const std::vector<std::string>& words, const std::string& word) {
    for (const std::string& w : words)
        if (w == word) return true;
    return words.empty();
}

// NAME=VALUE apart. False without '='.
bool split(const std::string& text, std::string& name, std::string& value) {
    const auto at = text.find('=');
    if (at == std::string::npos || at == 0) return false;
    name = text.substr(0, at);
    value = text.substr(at + 1);
    return true;
}

bool number(const std::string& text, double& value) {
    char* end = nullptr;
    value = std::strtod(text.c_str(), &end);
    return end != text.c_str() && *end == 0;
}

// Takes one option with its value. False if the value is none.
bool take_option(CommandLine& line, const std::string& option, const std::string& value) {
    std::string name, text;
    if (option == "--plugin")
        line.setup.plugin = value;
    else if (option == "--host")
        line.setup.host = value;
    else if (option == "--check")
        line.only.push_back(value);
    else if (option == "--context")
        line.job.context = value;
    else if (option == "-o")
        line.job.output = value;
    else if (option == "--param" && split(value, name, text))
        line.setup.params[name] = text;
    else if (option == "--edit" && split(value, name, text))
        line.job.edits.emplace_back(name, text);
    else if (option == "--clip" && split(value, name, text))
        line.job.clips[name] = text;
    else if (option == "--alpha" && (value == "premultiplied" || value == "unpremultiplied"))
        line.job.is_unpremultiplied = value == "unpremultiplied";
    else if (option == "--time")
        return number(value, line.job.time);
    else if (option == "--scale")
        return number(value, line.job.scale) && line.job.scale > 0 && line.job.scale <= 1;
    else if (option == "--timeout")
        return number(value, line.timeout_s) && line.timeout_s > 0 && line.timeout_s < 1e6;
    else if (option == "--size")
        return std::sscanf(value.c_str(), "%dx%d", &line.setup.width, &line.setup.height) == 2 &&
               line.setup.width >= 32 && line.setup.height >= 32 && line.setup.width <= 8192 &&
               line.setup.height <= 8192;
    else
        return false;
    return true;
}

CommandLine parsed(std::span<char*> words) {
    CommandLine line;
    for (std::size_t i = 0; i < words.size() && line.problem.empty(); ++i) {
        const std::string word = words[i];
        if (word.empty() || word[0] != '-') {
            line.bundles.push_back(word);
        } else if (i + 1 == words.size()) {
            line.problem = word + " needs a value, or is unknown; see ofx-check --help";
        } else if (!take_option(line, word, words[++i])) {
            line.problem = "'" + word + " " + words[i] + "' is not understood; see ofx-check --help";
        }
    }
    if (line.problem.empty() && line.bundles.size() != 1)
        line.problem = "one bundle is needed; see ofx-check --help";
    return line;
}

void check_bundle(const Bundle& bundle, Outcomes& outcomes) {
    const auto say = [&](char kind, const char* rule, const std::string& why) {
        take(outcomes, kind + std::string(rule) + '\t' + why, "bundle");
    };
    say(bundle.problem.empty() ? '+' : '!', "bundle.layout", bundle.problem);
    const std::vector<std::string> names = exported_names(bundle.library);
    for (const char* needed : {"OfxGetNumberOfPlugins", "OfxGetPlugin"})
        say(!names.empty() && is_listed(names, needed) ? '+' : '!', "exports.required",
            std::string(needed) + " is missing");
    std::vector<std::string> others;
    for (const std::string& name : names)
        if (name != "OfxGetNumberOfPlugins" && name != "OfxGetPlugin" && name != "OfxSetHost")
            others.push_back(name);
    say(others.empty() ? '+' : '!', "exports.only",
        others.empty() ? "" : std::to_string(others.size()) + " others, the first is " + others[0]);
}

// One line a rule. Returns how many are broken.
int print(const Outcomes& outcomes) {
    int broken = 0;
    for (const Rule& rule : rules()) {
        const auto found = outcomes.find(rule.name);
        const Outcome outcome = found == outcomes.end() ? Outcome{} : found->second;
        if (outcome.is_broken) {
            std::printf("BROKEN  %-22s %s [%s; check: %s]\n", rule.name, outcome.why.c_str(), rule.page,
                        outcome.check.c_str());
            ++broken;
        } else if (outcome.tried) {
            std::printf("ok      %-22s %s\n", rule.name, rule.says);
        } else {
            std::printf("-       %-22s not tried: %s\n", rule.name,
                        outcome.why.empty() ? "no check reached this rule" : outcome.why.c_str());
        }
    }
    return broken;
}

int check(const CommandLine& line, const Bundle& bundle) {
    Outcomes outcomes;
    check_bundle(bundle, outcomes);
    for (const Check& one : all_checks())
        if (is_listed(line.only, one.name)) run_check(one, line.setup, line.timeout_s, outcomes);
    const int broken = print(outcomes);
    std::printf("%s: %d broken rule%s\n", line.bundles[0].c_str(), broken, broken == 1 ? "" : "s");
    return broken > 0 ? 1 : 0;
}

int list(const std::string& what) {
    if (what == "--help" || what == "-h") std::fputs(kUsage, stdout);
    if (what == "--rules")
        for (const Rule& rule : rules()) std::printf("%-22s %s [%s]\n", rule.name, rule.says, rule.page);
    if (what == "--checks")
        for (const Check& one : all_checks()) std::printf("%s\n", one.name.c_str());
    return 0;
}

}  // namespace

int main(int count, char** words) {
    std::string first = count > 1 ? words[1] : "--help";
    if (first == "render" && count == 3 && std::string(words[2]) == "--help") first = "--help";
    if (first == "--help" || first == "-h" || first == "--rules" || first == "--checks") return list(first);
    const bool renders = first == "render";
    CommandLine line = parsed(std::span(words, std::size_t(count)).subspan(renders ? 2 : 1));
    if (!line.problem.empty()) return refuse(line.problem);
    const Bundle bundle = find_bundle(line.bundles[0]);
    if (bundle.library.empty()) return refuse(bundle.problem);
    line.setup.library = bundle.library;
    if (!renders) return check(line, bundle);
    const std::string problem = render_picture(line.setup, line.job);
    return problem.empty() ? 0 : refuse(problem);
}
