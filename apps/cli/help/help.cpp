// petzval help: what all verbs say of themselves, as a page, a manual or completions for a shell.
#include "console/console.h"
#include "flags/values.h"
#include "help/help_forms.h"
#include "output.h"
#include "verbs.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {
namespace {

struct Form {
    std::string (*write)(const VerbHelp&);
};

// The help of a verb, such as "lens psf", as its --help shows it.
Status print_verb(const VerbHelp& program, const std::vector<std::string>& words) {
    const VerbHelp* found = &program;
    for (const std::string& word : words) {
        std::vector<std::string> known;
        const VerbHelp* next = nullptr;
        for (const VerbHelp& verb : found->verbs) {
            known.push_back(verb.last_name());
            if (verb.last_name() == word) next = &verb;
        }
        if (!next)
            return Error{ErrorCode::InvalidArgument, "there is no verb " + word + did_you_mean(word, known) +
                                                         "; " + found->name + " --help shows how it is used"};
        found = next;
    }
    return write_text("-", as_text(*found, false));
}

std::string as_whole_text(const VerbHelp& program) { return as_text(program, true); }

const NameTable<Form> kForms{{"text", {as_whole_text}}, {"md", {as_markdown}}, {"man", {as_manual}},
                             {"bash", {as_bash}},       {"zsh", {as_zsh}},     {"fish", {as_fish}}};

}  // namespace

void add_help(Verb& program, Action& chosen) {
    struct Flags {
        std::vector<std::string> verb;
        std::optional<Form> form;
        std::string save_to = "-";
    };
    Verb& verb = add_verb(program, "help",
                          "help of a verb; all verbs as one page or a manual, or completions for a shell",
                          "petzval help lens psf\n"
                          "petzval help --format man --save petzval.1\n"
                          "source <(petzval help --format bash)");
    auto flags = std::make_shared<Flags>();
    FlagGroup(verb, "Verb").words("VERB", "verb whose help is shown; without it, all verbs", flags->verb);
    FlagGroup(verb, "Output")
        .choice("--format", "text (default), Markdown, a manual page, or completions for bash, zsh and fish",
                kForms, flags->form)
        .writes("--save", "FILE", "output file; - is standard output (default)", flags->save_to);
    when_typed(verb, [flags, &program, &chosen] {
        if (!flags->verb.empty() && (flags->form || flags->save_to != "-"))
            throw UsageError("--format and --save write the help of all verbs; leave out the verb");
        chosen = [flags, &program]() -> Status {
            if (!flags->verb.empty()) return print_verb(help_of(program), flags->verb);
            return write_text(flags->save_to,
                              flags->form.value_or(Form{as_whole_text}).write(help_of(program)));
        };
    });
}

}  // namespace petzval::cli
