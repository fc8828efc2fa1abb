// Help of the verbs in every form for people and shells, made from the declarations of the flags.
#pragma once

#include <string>
#include <vector>

namespace petzval::cli {

struct FlagHelp {
    std::string heading;             // under which it stands
    std::vector<std::string> names;  // "-o", "--output"; none of a plain argument
    std::string placeholder;         // "OUT", empty of a switch; of an argument its name
    std::string help;

    bool is_argument() const { return names.empty(); }
    std::string shown() const;                 // "-o, --output OUT"
    std::vector<std::string> choices() const;  // of "off|on"; none where it is not a choice
    bool is_file() const;
};

struct VerbHelp {
    static constexpr const char* kLastHeading = "Help";

    std::string name;              // "petzval lens list"
    std::string purpose, example;  // one command a line
    std::vector<FlagHelp> flags;   // in the order of their headings
    std::vector<VerbHelp> verbs;

    std::string last_name() const { return name.substr(name.rfind(' ') + 1); }
    std::string usage() const;  // "petzval compare REF TEST [flags]"
};

// --help: the common flags where a verb has many; --help-all: all flags.
std::string as_text(const VerbHelp& verb, bool all);
std::string as_markdown(const VerbHelp& program);  // all verbs, for docs/reference/command-line.md
std::string as_manual(const VerbHelp& program);    // mdoc
std::string as_bash(const VerbHelp& program);      // completions
std::string as_zsh(const VerbHelp& program);
std::string as_fish(const VerbHelp& program);

}  // namespace petzval::cli
