#include "help/help_forms.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace petzval::cli {
namespace {

// Every character of the text that is in `which` becomes what `form` says.
template <typename Form>
std::string escaped(const std::string& text, const std::string& which, const Form& form) {
    std::string safe;
    for (const char c : text) safe += which.find(c) == std::string::npos ? std::string(1, c) : form(c);
    return safe;
}

std::string with_backslash(const std::string& text, const std::string& which) {
    return escaped(text, which, [](char c) { return std::string("\\") + c; });
}

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// Characters, of UTF-8.
std::size_t width_of(const std::string& text) {
    return std::size_t(std::count_if(text.begin(), text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

// Two columns; the right one is wrapped.
std::string row(const std::string& left, const std::string& right) {
    constexpr std::size_t kColumn = 30, kWidth = 100;
    std::string text = "  " + left;
    std::size_t length = width_of(text);
    if (length + 2 > kColumn) text += "\n", length = 0;
    std::istringstream words(right);
    std::string word;
    for (bool first = true; words >> word; first = false) {
        if (first || length + 1 + width_of(word) > kWidth) {
            if (!first) text += "\n", length = 0;
            text += std::string(kColumn - length, ' '), length = kColumn;
        } else {
            text += " ", ++length;
        }
        text += word, length += width_of(word);
    }
    return text + "\n";
}

// Calls visit(flag, whether a new heading begins).
template <typename Visit>
void for_each_flag(const VerbHelp& verb, const Visit& visit) {
    std::string heading;
    for (const FlagHelp& flag : verb.flags) {
        visit(flag, flag.heading != heading);
        heading = flag.heading;
    }
}

void add_markdown(const VerbHelp& verb, std::string& out) {
    for (const VerbHelp& sub : verb.verbs) add_markdown(sub, out);
    if (!verb.verbs.empty()) return;
    out += "### `" + verb.usage() + "`\n\n" + verb.purpose + "\n\n```text\n" + verb.example +
           "\n```\n\n| | |\n|---|---|\n";
    for_each_flag(verb, [&](const FlagHelp& flag, bool begins) {
        if (flag.heading == VerbHelp::kLastHeading) return;
        if (begins) out += "| **" + flag.heading + "** | |\n";
        out += "| `" + with_backslash(flag.shown(), "|") + "` | " + with_backslash(flag.help, "|<*") + " |\n";
    });
    out += "\n";
}

// Text of a manual page, where words and line starts may be commands, and letters are ASCII.
std::string roff(const std::string& text) {
    std::string safe = escaped(text, "\\", [](char) { return std::string("\\e"); });
    for (const auto& [letter, name] : {std::pair{"…", "\\[u2026]"}, {"°", "\\[de]"}, {"×", "\\[mu]"}})
        for (std::size_t at = safe.find(letter); at != std::string::npos; at = safe.find(letter))
            safe.replace(at, std::string(letter).size(), name);
    return safe.starts_with(".") || safe.starts_with("'") ? "\\&" + safe : safe;
}
// A paragraph in short lines, one sentence per line.
std::string filled(const std::string& text) {
    constexpr std::size_t kWidth = 76;
    std::istringstream words(text);
    std::string page, line;
    for (std::string word; words >> word;) {
        if (!line.empty() && (line.ends_with(".") || line.size() + 1 + word.size() > kWidth))
            page += roff(line) + "\n", line.clear();
        line += (line.empty() ? "" : " ") + word;
    }
    return page + roff(line) + "\n";
}
// The text quoted as a roff argument.
std::string roff_quoted(const std::string& text) {
    return "\"" + escaped(roff(text), "\"", [](char) { return std::string("\\(dq"); }) + "\"";
}

void add_manual(const VerbHelp& verb, std::string& out) {
    for (const VerbHelp& sub : verb.verbs) add_manual(sub, out);
    if (!verb.verbs.empty()) return;
    out += ".Ss " + roff_quoted(verb.usage().substr(0, verb.usage().find(" ["))) + "\n" +
           filled(verb.purpose + ".") + ".Bd -literal -offset indent\n";
    for (const std::string& line : lines_of(verb.example)) out += roff(line) + "\n";
    out += ".Ed\n";
    for_each_flag(verb, [&](const FlagHelp& flag, bool begins) {
        if (begins)
            out += (&flag == &verb.flags.front() ? ".Pp\n" : ".El\n.Pp\n") + roff(flag.heading) +
                   ":\n.Bl -tag -width Ds\n";
        out += ".It " + roff_quoted(flag.shown()) + "\n" + filled(flag.help);
    });
    if (!verb.flags.empty()) out += ".El\n";
}

constexpr std::size_t kManyFlags = 40;

bool is_common(const FlagHelp& flag) {
    static const std::set<std::string> kCommon{
        "--depth",    "--plate",    "--mask",          "--focal-length", "--sensor-width", "--fstop",
        "--focus",    "--focus-at", "--focus-range",   "--look",         "--lens",         "--blades",
        "--cats-eye", "--bloom",    "--star",          "--engine",       "--quality",      "--fill",
        "-o",         "--view",     "--frames",        "--track",        "--temporal",     "--no-clobber",
        "--json",     "--exposure", "--device",        "--threads",      "--scene",        "--against",
        "--script",   "-h",         "--help-all",      "--defocus",      "--field",        "--size",
        "--columns",  "--raw",      "--add-spherical", "--coma",         "--bits",         "--tone",
        "--listen"};
    return flag.is_argument() || kCommon.contains(flag.names.front());
}

// A long list of choices is NAME.
FlagHelp in_short(FlagHelp flag) {
    constexpr std::size_t kLongest = 60;
    if (flag.placeholder.size() > kLongest) flag.placeholder = "NAME";
    return flag;
}

// Up to the first semicolon or colon, without a bracket at its end.
std::string first_clause(const std::string& help) {
    const std::string clause = help.substr(0, help.find_first_of(";:"));
    const std::size_t bracket = clause.find(" (");
    return bracket == std::string::npos ? clause : clause.substr(0, bracket);
}

}  // namespace

std::string FlagHelp::shown() const {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    if (!placeholder.empty() && placeholder != " ") text += (text.empty() ? "" : " ") + placeholder;
    return text;
}

std::vector<std::string> FlagHelp::choices() const {
    const bool words =
        placeholder.find('|') != std::string::npos &&
        std::all_of(placeholder.begin(), placeholder.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '|';
        });
    std::vector<std::string> all;
    std::istringstream in(words ? placeholder : "");
    for (std::string word; std::getline(in, word, '|');) all.push_back(word);
    return all;
}

bool FlagHelp::is_file() const {
    for (const char* word : {"FILE", "FOLDER", "OUT", "PATH", "FAR", "IN", "REF", "TEST"})
        if (placeholder.starts_with(word)) return true;
    return false;
}

std::string VerbHelp::usage() const {
    if (!verbs.empty()) return name + " VERB …";
    std::string text = name, output;
    for (const FlagHelp& flag : flags) {
        if (flag.is_argument()) text += " " + flag.placeholder;
        if (!flag.is_argument() && flag.names.front() == "-o") output = "-o " + flag.placeholder;
    }
    // The first example is the shortest command: an output that it leaves out is optional.
    const bool needs_output = example.substr(0, example.find('\n')).find(" -o ") != std::string::npos;
    if (!output.empty()) text += needs_output ? " " + output : " [" + output + "]";
    return text + " [flags]";
}

// Example, usage, purpose, and the flags by heading. The short form fits one screen.
std::string as_text(const VerbHelp& verb, bool all) {
    const bool is_short = !all && verb.flags.size() > kManyFlags;
    std::string out;
    if (!verb.example.empty()) out += "Example\n";
    for (const std::string& line : lines_of(verb.example)) out += "  " + line + "\n";
    if (!verb.example.empty()) out += "\n";
    out += verb.usage() + "\n" + verb.purpose + "\n";
    if (!verb.verbs.empty()) out += "\nVerbs\n";
    for (const VerbHelp& sub : verb.verbs) out += row(sub.last_name(), sub.purpose);
    if (is_short) out += "\nCommon flags (" + verb.name + " --help-all lists all)\n";
    for_each_flag(verb, [&](const FlagHelp& flag, bool begins) {
        if (is_short) {
            if (is_common(flag)) out += row(in_short(flag).shown(), first_clause(flag.help));
            return;
        }
        if (begins) out += "\n" + flag.heading + "\n";
        out += row(flag.shown(), flag.help);
    });
    return out;
}

std::string as_markdown(const VerbHelp& program) {
    std::string out;
    add_markdown(program, out);
    return out;
}

std::string as_manual(const VerbHelp& program) {
    constexpr const char* kFormOf =
        "November 22, 2026";  // the day on which the form of this page was last changed
    std::string out =
        std::string(".Dd ") + kFormOf + "\n.Dt PETZVAL 1\n.Os\n.Sh NAME\n.Nm petzval\n.Nd " +
        program.purpose +
        "\n.Sh SYNOPSIS\n.Nm\n.Ar verb\n.Op Ar flags\n.Sh DESCRIPTION\nThe verbs and their flags:\n";
    add_manual(program, out);
    return out + R"(.Sh ENVIRONMENT
.Bl -tag -width Ds
.It Ev PETZVAL_KERNEL_CACHE
Where kernels that take long to make are kept between runs; off keeps none.
.It Ev OCIO
The OpenColorIO config of
.Fl -ocio .
.It Ev NO_COLOR
No colour on a terminal.
.El
.Sh EXIT STATUS
0 where all went well;
1 where the work or an output failed;
2 for a command line that cannot be meant;
3 for a file that is missing or damaged;
130 and 143 after an interrupt.
)";
}

}  // namespace petzval::cli
