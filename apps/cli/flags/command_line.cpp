#include "flags/command_line.h"

#include "petzval/version.h"

#include "revision.h"
#include "verbs.h"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

namespace petzval::cli {
namespace {

std::string verb_of(const CLI::App& program) {
    std::string verb;
    for (auto next = program.get_subcommands(); !next.empty(); next = next[0]->get_subcommands())
        verb += (verb.empty() ? "" : " ") + next[0]->get_name();
    return verb;
}

void add_verbs(Verb& program, Action& chosen) {
    add_defocus(program, chosen);
    add_inspect(program, chosen);
    add_scene(program, chosen);
    add_compare(program, chosen);
    add_develop(program, chosen);
    add_focus_track(program, chosen);
    add_sheet(program, chosen);
    add_lens(program, chosen);
    add_devices(program, chosen);
    add_farm(program, chosen);
    add_view(program, chosen);
    add_help(program, chosen);
}

void add_to(Verb& program, Action& chosen) {
    use_our_help(program);
    program.footer(
        "petzval scene make night -o night.exr\n"
        "petzval defocus night.exr -o out.exr\n"
        "petzval develop out.exr -o out.png");
    program.set_help_flag("-h,--help", "this page; petzval VERB --help has the flags of a verb")
        ->group("Help");
    program.set_version_flag("--version", "petzval " PETZVAL_VERSION + source_revision())
        ->description("the version")
        ->group("Help");
    program.require_subcommand(0, 1);
    add_verbs(program, chosen);
}

Action say_on_standard_output(std::string text) {
    return [text = std::move(text)] {
        return print(text) ? Status(Done{})
                           : Error{ErrorCode::OutputFailed, "standard output cannot be written"};
    };
}

}  // namespace

Result<Action> parsed(int argc, const char* const* argv, Typed& typed) {
    // Actions refer to the verbs.
    const auto program =
        std::make_shared<CLI::App>("gives rendered pictures the depth of field of a real lens", "petzval");
    Action chosen;
    add_to(*program, chosen);
    try {
        program->parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return say_on_standard_output(program->help());
    } catch (const CLI::CallForAllHelp&) {
        return say_on_standard_output(program->help("", CLI::AppFormatMode::All));
    } catch (const CLI::CallForVersion& version) {
        return say_on_standard_output(std::string(version.what()) + "\n");
    } catch (const CLI::ParseError& error) {
        typed.verb = verb_of(*program);
        return Error{ErrorCode::InvalidArgument, usage_message(error, *program)};
    } catch (const UsageError& error) {
        typed.verb = verb_of(*program);
        if (error.code == ErrorCode::InvalidFile) typed.words = Words::Fields;
        return Error{error.code, error.what(), error.field};
    }
    typed.verb = verb_of(*program);
    if (!chosen) return Error{ErrorCode::InvalidArgument, "no verb given; petzval --help lists the verbs"};
    return Action([program, chosen = std::move(chosen)] { return chosen(); });
}

}  // namespace petzval::cli
