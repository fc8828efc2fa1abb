// petzval help: what all verbs say of themselves, as a page, a manual or completions for a shell.
#include "console/console.h"
#include "flags/values.h"
#include "help/help_forms.h"
#include "output.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

struct Form {
    std::string (*write)(const VerbHelp&);
};

std::string as_whole_text(const VerbHelp& program) { return as_text(program, true); }

const NameTable<Form> kForms{{"text", {as_whole_text}}, {"md", {as_markdown}}, {"man", {as_manual}},
                             {"bash", {as_bash}},       {"zsh", {as_zsh}},     {"fish", {as_fish}}};

}  // namespace

void add_help(Verb& program, Action& chosen) {
    struct Flags {
        Form form{as_whole_text};
        std::string save_to = "-";
    };
    Verb& verb = add_verb(program, "help", "this page; all verbs as a manual, or completions for a shell",
                          "petzval help\n"
                          "petzval help --format man --save petzval.1\n"
                          "source <(petzval help --format bash)");
    auto flags = std::make_shared<Flags>();
    FlagGroup(verb, "Output")
        .choice("--format", "text (default), Markdown, a manual page, or completions for bash, zsh and fish",
                kForms, flags->form)
        .writes("--save", "FILE", "output file; - is standard output (default)", flags->save_to);
    when_typed(verb, [flags, &program, &chosen] {
        chosen = [flags, &program]() -> Status {
            return write_text(flags->save_to, flags->form.write(help_of(program)));
        };
    });
}

}  // namespace petzval::cli
