// petzval: reads the command line, runs one verb, turns its outcome into one line and an exit code.
#include "console/console.h"
#include "console/interrupt.h"
#include "console/last_words.h"
#include "console/report.h"
#include "flags/command_line.h"
#include "frames.h"
#include "guard.h"

#include <exception>
#include <new>

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

// Errors: an invalid command line, or the errors of its action.
Status parse_and_act(int argc, const char* const* argv, Typed& typed) {
    const auto chosen = parsed(argc, argv, typed);
    if (!chosen) return chosen.error();
    if (Status fine = run_files().check(); !fine) return fine;
    Status done = (*chosen)();
    if (interrupted_by() != 0) return Error{ErrorCode::Cancelled, "interrupted"};
    return done;
}

int run(int argc, const char* const* argv) {
    Typed typed;
    const Status done = parse_and_act(argc, argv, typed);
    if (done) return 0;
    const int code = exit_code(done.error());
    if (asks_for_json(argc, argv))  // the line on standard error is written in any case
        static_cast<void>(write_record(failure_record(typed.verb, done.error(), code), "-"));
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
