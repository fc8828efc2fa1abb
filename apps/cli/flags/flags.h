// The flags of a verb: declared in groups, each with one value and given at most once, told as help and
// refused in one line.
#pragma once

#include "petzval/result.h"

#include "console/console.h"
#include "flags/values.h"

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class ParseError;
}  // namespace CLI

namespace petzval::cli {

// A verb, or the program itself: what flags are added to. CLI11 stays behind this name, in flags.cpp and
// main.cpp.
using Verb = CLI::App;

// A command line that cannot be meant. Thrown while flags are read, shown by main as one line, exit code 2.
struct UsageError : std::runtime_error {
    explicit UsageError(const std::string& message, ErrorCode why = ErrorCode::InvalidArgument,
                        std::string which = "")
        : std::runtime_error(message), code(why), field(std::move(which)) {}
    ErrorCode code;     // that of a file, where a file is what is wrong
    std::string field;  // of a look, where one is wrong
};

// The action of a command line; main runs it after parsing the whole line.
using Action = std::function<Status()>;

// A verb of the program. `example` is what its --help shows first, one command per line.
Verb& add_verb(Verb& parent, const std::string& name, const std::string& purpose, const std::string& example);
// Throws UsageError for the error of a check in the library, in the words of flags.
void refuse(const Status& fine);

// Once the whole line has been read without an error: checks the flags, throws UsageError, or chooses an
// action.
void when_typed(Verb& verb, std::function<void()> choose);
// The same for flags in a struct. `check` gets the flags and the verb, `act` gets the flags.
template <typename Flags>
void when_typed(Verb& verb, Action& chosen, const std::shared_ptr<Flags>& flags,
                void (*check)(std::type_identity_t<Flags>&, const Verb&),
                Status (*act)(const std::type_identity_t<Flags>&)) {
    when_typed(verb, [flags, check, act, &verb, &chosen] {
        check(*flags, verb);
        chosen = [flags, act] { return act(*flags); };
    });
}
// Throws UsageError unless one of the verb's own verbs was typed too.
void require_verb(const Verb& verb);
// Help in this program's form, for the program itself and all its verbs.
void use_our_help(Verb& program);

// Help of a verb and its subverbs (help_forms.h).
struct VerbHelp;
VerbHelp help_of(const Verb& verb);

// Flags that stand together under one heading of the help.
class FlagGroup {
public:
    FlagGroup(Verb& verb, std::string heading) : verb_(verb), heading_(std::move(heading)) {}

    // "--name VALUE". `parse` turns the text into Result<a type that fits `target`>.
    template <typename Parse, typename Target>
    FlagGroup& value(const std::string& name, const std::string& placeholder, const std::string& help,
                     Parse parse, Target& target) {
        add(name, placeholder, help, [name = long_name(name), parse, &target](const std::string& text) {
            auto parsed = parse(text);
            if (!parsed) throw UsageError(name + " " + text + ": " + parsed.error().message);
            target = std::move(parsed.value());
        });
        return *this;
    }
    // "--name A|B|C": one of the names of a table, see values.h, or of a public enum.
    template <typename T, typename Target>
    FlagGroup& choice(const std::string& name, const std::string& help, const NameTable<T>& table,
                      Target& target) {
        const auto parse = [table](const std::string& text) { return parse_name(text, table); };
        return value(name, placeholder_of(table), help, parse, target);
    }
    template <typename E, typename Target>
    FlagGroup& choice(const std::string& name, const std::string& help, Target& target) {
        return choice(name, help, name_table<E>(), target);
    }
    // "--name VALUE…": one or more texts.
    FlagGroup& values(const std::string& name, const std::string& placeholder, const std::string& help,
                      std::vector<std::string>& target);
    // "--name FILE": a file that the run reads, or writes; the file is registered with the guard (guard.h).
    // Only that of writes_frames() may hold a frame number.
    FlagGroup& reads(const std::string& name, const std::string& placeholder, const std::string& help,
                     std::string& target);
    FlagGroup& writes(const std::string& name, const std::string& placeholder, const std::string& help,
                      std::string& target);
    FlagGroup& writes_frames(const std::string& name, const std::string& placeholder, const std::string& help,
                             std::string& target);
    // "--name", without a value.
    template <typename Target>
    FlagGroup& on(const std::string& name, const std::string& help, Target& target) {
        add_switch(name, help, [&target](bool on) { target = on; });
        return *this;
    }
    // A positional argument. If it is a file, it is registered with the guard as an input.
    FlagGroup& argument(const std::string& name, const std::string& help, std::string& target);
    // All plain arguments, the same.
    FlagGroup& arguments(const std::string& name, const std::string& help, std::vector<std::string>& target);
    // Plain arguments that name no files: another command line, after "--".
    FlagGroup& words(const std::string& name, const std::string& help, std::vector<std::string>& target);

private:
    void add(const std::string& name, const std::string& placeholder, const std::string& help,
             std::function<void(const std::string&)> take);
    void add_switch(const std::string& name, const std::string& help, std::function<void(bool)> take);
    static std::string long_name(const std::string& names);  // "-o,--output" is shown as "-o"

    Verb& verb_;
    std::string heading_;
};

// The name of one file. Errors: InvalidArgument if it holds a frame number.
Result<std::string> parse_one_file(const std::string& text);

// Reads words as the command line of a verb. Throws UsageError, in the words of `name`.
void read_words(const std::string& name, const std::function<void(Verb&)>& add,
                const std::vector<std::string>& words);

// Flags, values and arguments typed under these headings, as words of a command line.
std::vector<std::string> typed_words(const Verb& verb, const std::vector<std::string>& headings,
                                     const std::vector<std::string>& without);

// Throws UsageError unless `given` is not empty.
void require_argument(const Verb& verb, const std::string& given, const std::string& name);
// Throws UsageError if both were given.
void refuse_both(bool first, const std::string& first_name, bool second, const std::string& second_name);

// One line for an error that CLI11 found in a command line.
std::string usage_message(const CLI::ParseError& error, const Verb& program);

}  // namespace petzval::cli
