// petzval: reads the command line, runs one verb, turns its outcome into one line and an exit code.
#include "petzval/names.h"
#include "petzval/version.h"

#include "console/console.h"
#include "console/interrupt.h"
#include "console/last_words.h"
#include "console/report.h"
#include "flags/fields.h"
#include "frames.h"
#include "guard.h"
#include "revision.h"
#include "verbs.h"

#include <exception>
#include <new>

#include <CLI/CLI.hpp>

namespace petzval::cli {
namespace {

// Exit codes of docs/reference/exit-codes.md.
int exit_code(const Error& error) {
    // A device that fails at its work was not chosen wrongly.
    const bool is_device = error.field == "session.device" && !error.message.starts_with(error.field);
    switch (error.code) {
        case ErrorCode::InvalidArgument:
            return 2;
        case ErrorCode::Unsupported:
            return is_device ? 1 : 2;
        case ErrorCode::InvalidFile:
            return 3;
        case ErrorCode::Cancelled:
            return 128 + interrupted_by();
        default:
            return 1;
    }
}

int fail(int code, const std::string& message, Words words = Words::Flags) {
    failure(message, words);
    return code;
}

// "--json -", also in a line that is wrong elsewhere.
bool asks_for_json(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--json=-" || (word == "--json" && i + 1 < argc && std::string(argv[i + 1]) == "-"))
            return true;
    }
    return false;
}

// Writes the failure as JSON instead of a report.
void print_failure(int exit_code, const Error& error, const std::string& verb) {
    Json report = new_report(verb);
    if (verb.empty()) report["verb"] = nullptr;
    report["failure"] = {{"code", name_of(error.code)},
                         {"message", in_flags(error.message)},
                         {"field", error.field.empty() ? Json(nullptr) : Json(error.field)},
                         {"exit_code", exit_code}};
    static_cast<void>(write_report(report, "-"));  // the line on standard error is written in any case
}

// Data about a failing command line.
struct Typed {
    Words words = Words::Flags;  // of the message
    std::string verb;            // as in a report: "lens psf"; empty if none was understood
};

std::string verb_of(const CLI::App& program) {
    std::string verb;
    for (auto next = program.get_subcommands(); !next.empty(); next = next[0]->get_subcommands())
        verb += (verb.empty() ? "" : " ") + next[0]->get_name();
    return verb;
}

// Errors: an invalid command line, or the errors of its action.
Status parse_and_act(int argc, const char* const* argv, Typed& typed) {
    CLI::App program("gives rendered pictures the depth of field of a real lens", "petzval");
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
    Action chosen;
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
    const auto said = [](const std::string& text) {
        return print(text) ? Status(Done{})
                           : Error{ErrorCode::OutputFailed, "standard output cannot be written"};
    };
    try {
        program.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return said(program.help());
    } catch (const CLI::CallForAllHelp&) {
        return said(program.help("", CLI::AppFormatMode::All));
    } catch (const CLI::CallForVersion& version) {
        return said(std::string(version.what()) + "\n");
    } catch (const CLI::ParseError& error) {
        typed.verb = verb_of(program);
        return Error{ErrorCode::InvalidArgument, usage_message(error, program)};
    } catch (const UsageError& error) {
        typed.verb = verb_of(program);
        if (error.code == ErrorCode::InvalidFile) typed.words = Words::Fields;
        return Error{error.code, error.what(), error.field};
    }
    typed.verb = verb_of(program);
    if (!chosen) return Error{ErrorCode::InvalidArgument, "no verb given; petzval --help lists the verbs"};
    if (Status fine = run_files().check(); !fine) return fine;
    Status done = chosen();
    if (interrupted_by() != 0) return Error{ErrorCode::Cancelled, "interrupted"};
    return done;
}

int run(int argc, const char* const* argv) {
    Typed typed;
    const Status done = parse_and_act(argc, argv, typed);
    if (done) return 0;
    const int code = exit_code(done.error());
    if (asks_for_json(argc, argv)) print_failure(code, done.error(), typed.verb);
    return fail(code, done.error().message, typed.words);
}

}  // namespace
}  // namespace petzval::cli

int main(int argc, char** argv) {
    using namespace petzval::cli;
    watch_for_interrupts();
    end_orderly_on_terminate();
    try {
        return run(argc, argv);
    } catch (const FramesFailed& failed) {
        return fail(failed.exit_code, failed.message);
    } catch (const DoubtsFound& found) {
        return fail(5, found.message);
    } catch (const std::bad_alloc&) {
        say_out_of_memory();
        return 1;
    } catch (const std::exception& error) {
        return fail(1, std::string("stopped by an unexpected error: ") + error.what());
    }
}
