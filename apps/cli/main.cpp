// petzval: reads the command line, runs one verb, turns its outcome into one line and an exit code.
#include "petzval/version.h"

#include "console.h"
#include "frames.h"
#include "interrupt.h"
#include "verbs.h"

#include <exception>
#include <new>

#include <CLI/CLI.hpp>

namespace petzval::cli {
namespace {

// Exit codes of docs/conventions.md.
int exit_code(ErrorCode code) {
    switch (code) {
        case ErrorCode::InvalidArgument:
        case ErrorCode::Unsupported:
            return 2;
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

int run(int argc, const char* const* argv) {
    CLI::App program("gives rendered pictures the depth of field of a real lens", "petzval");
    use_our_help(program);
    program.footer(
        "petzval scene make night -o night.exr\n"
        "petzval defocus night.exr -o out.exr\n"
        "petzval develop out.exr -o out.png");
    program.set_help_flag("-h,--help", "this page; petzval VERB --help has the flags of a verb")
        ->group("Help");
    program.set_version_flag("--version", "petzval " PETZVAL_VERSION)
        ->description("the version")
        ->group("Help");
    program.require_subcommand(0, 1);
    Action chosen;
    add_defocus(program, chosen);
    add_inspect(program, chosen);
    add_scene(program, chosen);
    add_compare(program, chosen);
    add_develop(program, chosen);
    add_lens(program, chosen);
    add_help(program, chosen);
    try {
        program.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return print(program.help()) ? 0 : fail(1, "standard output cannot be written");
    } catch (const CLI::CallForVersion& version) {
        return print(std::string(version.what()) + "\n") ? 0 : fail(1, "standard output cannot be written");
    } catch (const CLI::ParseError& error) {
        return fail(2, usage_message(error, program));
    } catch (const UsageError& error) {
        const bool of_file = error.code == ErrorCode::InvalidFile;
        return fail(exit_code(error.code), error.what(), of_file ? Words::Fields : Words::Flags);
    }
    if (!chosen) return fail(2, "what is to be done? petzval --help lists the verbs, as defocus and inspect");
    Status done = chosen();
    if (interrupted_by() != 0) return fail(128 + interrupted_by(), "interrupted");
    return done ? 0 : fail(exit_code(done.error().code), done.error().message);
}

}  // namespace
}  // namespace petzval::cli

int main(int argc, char** argv) {
    using namespace petzval::cli;
    watch_for_interrupts();
    try {
        return run(argc, argv);
    } catch (const FramesFailed& failed) {
        return fail(4, failed.message);
    } catch (const std::bad_alloc&) {
        return fail(1, "not enough memory; --max-memory or a smaller picture needs less");
    } catch (const std::exception& error) {
        return fail(1, std::string("stopped by an unexpected error: ") + error.what());
    }
}
