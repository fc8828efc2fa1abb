// Completions of the command line, for three shells.
#include "petzval/lens_facts.h"

#include "console/console.h"
#include "help/help_forms.h"

#include <algorithm>

namespace petzval::cli {
namespace {

std::string in_a_row(const std::vector<std::string>& words) { return joined(words, " "); }

// The words that may follow a flag, as far as they are known.
std::vector<std::string> values_of(const FlagHelp& flag) {
    if (flag.names.empty() || flag.names.back() != "--lens") return flag.choices();
    std::vector<std::string> lenses;
    for (const LensSummary& lens : lens_list()) lenses.push_back(lens.name);
    return lenses;
}

std::vector<std::string> names_of(const std::vector<VerbHelp>& verbs) {
    std::vector<std::string> names;
    for (const VerbHelp& verb : verbs) names.push_back(verb.last_name());
    return names;
}

// The verb and all below it.
template <typename Visit>
void for_each_verb(const VerbHelp& verb, const Visit& visit) {
    visit(verb);
    for (const VerbHelp& sub : verb.verbs) for_each_verb(sub, visit);
}

// Within single quotes of a shell.
std::string quoted(const std::string& text, const std::string& also = "") {
    std::string safe = "'";
    for (const char c : text) {
        if (also.find(c) != std::string::npos) safe += '\\';
        safe += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return safe + "'";
}

std::string function_of(const VerbHelp& verb) {
    std::string name = "_" + verb.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

// One line of _arguments.
std::string zsh_argument(const FlagHelp& flag) {
    if (flag.is_argument()) return quoted("*:" + flag.placeholder + ":_files");
    const std::vector<std::string> values = values_of(flag);
    const std::string after = flag.placeholder.empty()
                                  ? ""
                                  : ":" + std::string(values.empty() ? flag.placeholder : "value") + ":" +
                                        (!values.empty()  ? "(" + in_a_row(values) + ")"
                                         : flag.is_file() ? "_files"
                                                          : " ");
    const std::string help = quoted("[" + flag.help, ":").substr(1);
    const std::string what = help.substr(0, help.size() - 1) + "]" + quoted(after).substr(1);
    if (flag.names.size() == 1) return "'" + flag.names.front() + what;
    return "'(" + in_a_row(flag.names) + ")'{" + joined(flag.names, ",") + "}'" + what;
}

std::string fish_condition(const VerbHelp& verb) {
    std::string condition, word;
    for (std::size_t at = verb.name.find(' '); at != std::string::npos;) {
        const std::size_t end = verb.name.find(' ', at + 1);
        condition += (condition.empty() ? "" : "; and ") + std::string("__fish_seen_subcommand_from ") +
                     verb.name.substr(at + 1, end - at - 1);
        at = end;
    }
    if (!verb.verbs.empty())
        condition += (condition.empty() ? "" : "; and ") + std::string("not __fish_seen_subcommand_from ") +
                     in_a_row(names_of(verb.verbs));
    return condition;
}

std::string fish_flag(const FlagHelp& flag) {
    std::string text;
    for (const std::string& name : flag.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    const std::vector<std::string> values = values_of(flag);
    if (!values.empty()) text += " -x -a " + quoted(in_a_row(values));
    if (values.empty() && !flag.placeholder.empty()) text += flag.is_file() ? " -r" : " -x";
    return text + " -d " + quoted(flag.help, "\\");
}

}  // namespace

std::string as_bash(const VerbHelp& program) {
    std::vector<std::string> verbs;
    std::string values, words;
    for_each_verb(program, [&](const VerbHelp& verb) {
        if (&verb != &program) verbs.push_back(quoted(verb.name));
        std::vector<std::string> offered = names_of(verb.verbs);
        for (const FlagHelp& flag : verb.flags) {
            offered.insert(offered.end(), flag.names.begin(), flag.names.end());
            for (const std::string& name : flag.names)
                if (const auto after = values_of(flag); !after.empty())
                    values += "        " + quoted(verb.name + " " + name) +
                              ") words=" + quoted(in_a_row(after)) + " ;;\n";
        }
        words += "            " + quoted(verb.name) + ") words=" + quoted(in_a_row(offered)) + " ;;\n";
    });
    return "# petzval in bash; made by: petzval help --format bash\n"
           "_petzval() {\n"
           "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verb=petzval words='' "
           "word\n"
           "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
           "        case \"$verb $word\" in\n"
           "            " +
           joined(verbs, "|") +
           ") verb=\"$verb $word\" ;;\n"
           "        esac\n"
           "    done\n"
           "    case \"$verb $prev\" in\n" +
           values +
           "    esac\n"
           "    if [[ -z $words && ( $cur == -* || $verb == \"$prev\" || $verb == *\" $prev\" ) ]]; then\n"
           "        case \"$verb\" in\n" +
           words +
           "        esac\n"
           "    fi\n"
           "    COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
           "}\n"
           "complete -o default -F _petzval petzval\n";
}

std::string as_zsh(const VerbHelp& program) {
    std::string out = "#compdef petzval\n# made by: petzval help --format zsh\n";
    for_each_verb(program, [&](const VerbHelp& verb) {
        out += "\n" + function_of(verb) + "() {\n";
        if (!verb.verbs.empty()) out += "    local line state\n";
        out += "    _arguments" + std::string(verb.verbs.empty() ? "" : " -C");
        for (const FlagHelp& flag : verb.flags) out += " \\\n        " + zsh_argument(flag);
        if (!verb.verbs.empty())
            out += " \\\n        " + quoted("1:verb:(" + in_a_row(names_of(verb.verbs)) + ")") +
                   " \\\n        '*::arg:->verb'";
        out += "\n";
        if (!verb.verbs.empty()) out += "    case $line[1] in\n";
        for (const VerbHelp& sub : verb.verbs)
            out += "        " + sub.last_name() + ") " + function_of(sub) + " ;;\n";
        if (!verb.verbs.empty()) out += "    esac\n";
        out += "}\n";
    });
    return out + "\n_petzval \"$@\"\n";
}

std::string as_fish(const VerbHelp& program) {
    std::string out = "# petzval in fish; made by: petzval help --format fish\n";
    for_each_verb(program, [&](const VerbHelp& verb) {
        const std::string begin = "complete -c petzval -n " + quoted(fish_condition(verb));
        for (const VerbHelp& sub : verb.verbs)
            out += begin + " -f -a " + sub.last_name() + " -d " + quoted(sub.purpose, "\\") + "\n";
        for (const FlagHelp& flag : verb.flags)
            if (!flag.is_argument()) out += begin + fish_flag(flag) + "\n";
    });
    return out;
}

}  // namespace petzval::cli
