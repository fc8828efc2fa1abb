// The command line: its verbs and flags, and the action that a line chooses.
#pragma once

#include "console/console.h"
#include "flags/flags.h"

#include <string>

namespace petzval::cli {

// Data about a command line, for the message about its failure.
struct Typed {
    Words words = Words::Flags;  // of the message
    std::string verb;            // as in a report: "lens psf"; empty if none was understood
};

// Reads the line; the action is not called yet. Errors: InvalidArgument, or that of a file that a flag names.
Result<Action> parsed(int argc, const char* const* argv, Typed& typed);

}  // namespace petzval::cli
