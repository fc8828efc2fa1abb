#include "flags/flags.h"

#include "petzval/frames.h"

#include "flags/fields.h"
#include "guard.h"
#include "help/help_forms.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include <CLI/CLI.hpp>

namespace petzval::cli {
namespace {

// "petzval defocus"
std::string full_name(const Verb& verb) {
    return verb.get_parent() ? full_name(*verb.get_parent()) + " " + verb.get_name() : verb.get_name();
}

// "defocus", for messages, which begin with the program's name anyway.
std::string short_name(const Verb& verb) {
    const std::string name = full_name(verb);
    return name.substr(name.find(' ') + 1);
}

std::string first_example(const Verb& verb) {
    const std::string& examples = verb.get_footer();
    return examples.substr(0, examples.find('\n'));
}

// The verb that was being read, however deep.
const Verb& current(const Verb& app) {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? app : current(*parsed.front());
}

class Help : public CLI::FormatterBase {
    std::string make_help(const CLI::App* verb, std::string, CLI::AppFormatMode mode) const override {
        return as_text(help_of(*verb), mode == CLI::AppFormatMode::All);
    }
};

// The flag for a name that other programs use, where the verb has it.
std::string by_common_name(const std::string& word, const Verb& verb) {
    static const std::map<std::string, std::string> kFlags{{"--aperture", "--fstop"},
                                                           {"--f-number", "--fstop"},
                                                           {"--fnumber", "--fstop"},
                                                           {"--focus-distance", "--focus"}};
    const auto found = kFlags.find(word);
    return found != kFlags.end() && verb.get_option_no_throw(found->second) ? found->second : "";
}

std::string unknown_argument(const Verb& verb) {
    const auto extras = verb.remaining(true);
    // If a verb is expected, the first word is the verb, and later words were meant for it.
    auto odd = extras.begin();
    if (verb.get_subcommands({}).empty())
        odd = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e.starts_with("-"); });
    if (odd == extras.end()) odd = extras.begin();
    const std::string word = odd == extras.end() ? "?" : odd->substr(0, odd->find('='));
    std::vector<std::string> known;
    if (word.starts_with("-")) {
        for (const CLI::Option* flag : verb.get_options())
            for (const std::string& name : flag->get_lnames()) known.push_back("--" + name);
        const std::string common = by_common_name(word, verb);
        return "unknown flag " + word +
               (common.empty() ? did_you_mean(word, known) : " (did you mean " + common + "?)") + "; " +
               full_name(verb) + " --help lists the flags";
    }
    for (const CLI::App* sub : verb.get_subcommands({})) known.push_back(sub->get_name());
    if (known.empty()) {
        const CLI::Option* const output = verb.get_option_no_throw("-o");
        const bool may_be_output = output && output->empty() && verb.count_all() > 0;
        return "unexpected argument " + word + "; " +
               (may_be_output ? "write an output as -o " + word + "; " : "") + full_name(verb) +
               " --help shows how it is used";
    }
    return "unknown verb " + word + did_you_mean(word, known) + "; there are " + listed(known);
}

FlagHelp help_of(const CLI::Option& flag) {
    FlagHelp help{flag.get_group(), {}, flag.get_option_text(), flag.get_description()};
    if (flag.get_positional()) help.placeholder = flag.get_name();
    for (const std::string& name : flag.get_snames()) help.names.push_back("-" + name);
    for (const std::string& name : flag.get_lnames()) help.names.push_back("--" + name);
    return help;
}

}  // namespace

VerbHelp help_of(const Verb& verb) {
    VerbHelp help{full_name(verb), verb.get_description(), verb.get_footer(), {}, {}};
    std::vector<std::string> headings = verb.get_groups();
    std::stable_partition(headings.begin(), headings.end(),
                          [](const auto& heading) { return heading != VerbHelp::kLastHeading; });
    for (const std::string& heading : headings)
        for (const CLI::Option* flag : verb.get_options())
            if (!heading.empty() && flag->get_group() == heading) help.flags.push_back(help_of(*flag));
    for (const CLI::App* sub : verb.get_subcommands({})) help.verbs.push_back(help_of(*sub));
    return help;
}

Verb& add_verb(Verb& parent, const std::string& name, const std::string& purpose,
               const std::string& example) {
    Verb& verb = *parent.add_subcommand(name, purpose);
    verb.footer(example);
    verb.require_subcommand(0, 1);
    verb.set_help_flag("-h,--help", "show the common flags")->group(VerbHelp::kLastHeading);
    verb.set_help_all_flag("--help-all", "show all flags")->group(VerbHelp::kLastHeading);
    return verb;
}

void refuse(const Status& fine) {
    if (!fine) throw UsageError(in_flags(fine.error().message));
}

void when_typed(Verb& verb, std::function<void()> choose) { verb.callback(std::move(choose)); }

void require_verb(const Verb& verb) {
    if (!verb.get_subcommands().empty()) return;
    std::vector<std::string> names;
    for (const Verb* sub : verb.get_subcommands({})) names.push_back(sub->get_name());
    throw UsageError(full_name(verb) + " needs one of " + listed(names) +
                     "; for example: " + first_example(verb));
}

void use_our_help(Verb& program) { program.formatter(std::make_shared<Help>()); }

namespace {

// A negative number also begins with a dash.
bool is_short_flag(const std::string& text, const Verb& verb) {
    return text.size() == 2 && text[0] == '-' && verb.get_option_no_throw(text);
}

}  // namespace

void FlagGroup::add(const std::string& name, const std::string& placeholder, const std::string& help,
                    std::function<void(const std::string&)> take) {
    CLI::Option* flag = verb_.add_option(
        name,
        [spoken = long_name(name), take = std::move(take), &verb = verb_](const CLI::results_t& texts) {
            if (texts.size() > 1) throw UsageError(spoken + " is given more than once");
            if (texts.front().starts_with("--") || is_short_flag(texts.front(), verb))
                throw UsageError(spoken + " needs a value, but is followed by " + texts.front());
            take(texts.front());
            return true;
        },
        help);
    // All, so that the callback sees repetitions and can name them.
    flag->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    flag->option_text(placeholder)->group(heading_);
}

FlagGroup& FlagGroup::reads(const std::string& name, const std::string& placeholder, const std::string& help,
                            std::string& target) {
    const auto parse = [](const std::string& text) {
        auto path = parse_text(text);
        if (path) run_files().reads(*path);
        return path;
    };
    return value(name, placeholder, help, parse, target);
}

namespace {

Result<std::string> written(Result<std::string> path) {
    if (path) run_files().writes(*path);
    return path;
}

}  // namespace

Result<std::string> parse_one_file(const std::string& text) {
    if (!has_frame_number(text)) return parse_text(text);
    return Error{ErrorCode::InvalidArgument, "names many frames, but one file is written"};
}

FlagGroup& FlagGroup::writes(const std::string& name, const std::string& placeholder, const std::string& help,
                             std::string& target) {
    const auto parse = [](const std::string& text) { return written(parse_one_file(text)); };
    return value(name, placeholder, help, parse, target);
}

FlagGroup& FlagGroup::writes_frames(const std::string& name, const std::string& placeholder,
                                    const std::string& help, std::string& target) {
    const auto parse = [](const std::string& text) { return written(parse_text(text)); };
    return value(name, placeholder, help, parse, target);
}

FlagGroup& FlagGroup::values(const std::string& name, const std::string& placeholder, const std::string& help,
                             std::vector<std::string>& target) {
    const auto take = [spoken = long_name(name), &target](const CLI::results_t& texts) {
        for (const std::string& text : texts)
            if (text.empty()) throw UsageError(spoken + " needs a value");
        target = texts;
        return true;
    };
    CLI::Option* flag = verb_.add_option(name, take, help);
    flag->expected(1, CLI::detail::expected_max_vector_size)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args();
    flag->option_text(placeholder)->group(heading_);
    return *this;
}

void FlagGroup::add_switch(const std::string& name, const std::string& help, std::function<void(bool)> take) {
    const auto count = [spoken = long_name(name), take = std::move(take)](std::int64_t times) {
        if (times > 1) throw UsageError(spoken + " is given more than once");
        take(times == 1);
    };
    const auto on_or_off = [spoken =
                                name.substr(name.rfind(',') + 1)](const std::string& text) -> std::string {
        static const std::set<std::string> known{"true", "false", "on", "off", "1", "0"};
        if (!known.contains(text))
            throw UsageError(spoken + "=" + text + ": takes only on or off, such as " + spoken + "=off");
        return "";
    };
    verb_.add_flag_function(name, count, help)->check(on_or_off)->group(heading_);
}

FlagGroup& FlagGroup::argument(const std::string& name, const std::string& help, std::string& target) {
    verb_
        .add_option_function<std::string>(
            name,
            [&target](const std::string& text) {
                run_files().reads(text);
                target = text;
            },
            help)
        ->option_text(" ")
        ->group(heading_);
    return *this;
}

FlagGroup& FlagGroup::arguments(const std::string& name, const std::string& help,
                                std::vector<std::string>& target) {
    verb_
        .add_option_function<std::vector<std::string>>(
            name,
            [&target](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) run_files().reads(text);
                target = texts;
            },
            help)
        ->option_text(" ")
        ->group(heading_);
    return *this;
}

FlagGroup& FlagGroup::words(const std::string& name, const std::string& help,
                            std::vector<std::string>& target) {
    verb_.add_option(name, target, help)->option_text(" ")->group(heading_);
    return *this;
}

std::string FlagGroup::long_name(const std::string& names) { return names.substr(0, names.find(',')); }

std::vector<std::string> typed_words(const Verb& verb, const std::vector<std::string>& headings,
                                     const std::vector<std::string>& without) {
    const auto holds = [](const auto& list, const auto& word) {
        return std::find(list.begin(), list.end(), word) != list.end();
    };
    std::vector<std::string> words;
    for (const CLI::Option* flag : verb.get_options()) {
        if (flag->count() == 0 || !holds(headings, flag->get_group())) continue;
        if (holds(without, flag->get_name())) continue;
        if (!flag->get_positional()) words.push_back(flag->get_name());
        if (flag->get_expected_max() > 0)
            for (const std::string& value : flag->results()) words.push_back(value);
    }
    return words;
}

void read_words(const std::string& name, const std::function<void(Verb&)>& add,
                const std::vector<std::string>& words) {
    CLI::App program("", "petzval");
    Verb& verb = add_verb(program, name, "", "");
    add(verb);
    std::vector<std::string> reversed(words.rbegin(), words.rend());  // as CLI11 takes them
    reversed.push_back(name);
    try {
        program.parse(reversed);
    } catch (const CLI::ParseError& error) {
        throw UsageError(usage_message(error, program));
    }
}

void require_argument(const Verb& verb, const std::string& given, const std::string& name) {
    if (given.empty())
        throw UsageError(short_name(verb) + " needs " + name + "; for example: " + first_example(verb));
}

void refuse_both(bool first, const std::string& first_name, bool second, const std::string& second_name) {
    if (first && second)
        throw UsageError(first_name + " and " + second_name + " contradict each other; give one");
}

std::string usage_message(const CLI::ParseError& error, const Verb& program) {
    const Verb& verb = current(program);
    const std::string text = error.what();
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unknown_argument(verb);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))  // "--focus: 1 required M missing"
        return text.substr(0, text.find_first_of(": ")) + " needs a value; " + full_name(verb) +
               " --help shows which";
    return text + "; " + full_name(verb) + " --help shows how it is used";
}

}  // namespace petzval::cli
