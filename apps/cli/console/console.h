// Messages for people: one line at a time on standard error. Standard output is for results.
#pragma once

#include "petzval/frame_loop.h"
#include "petzval/reports/words.h"

#include <string>
#include <vector>

namespace petzval::cli {

enum class Verbosity { Quiet, Normal, Verbose };

// Set once, when the flags have been read.
void set_verbosity(Verbosity verbosity);

// True if standard error is a terminal and NO_COLOR is not set (no-color.org).
bool colour_wanted();

void note(const std::string& line);     // unless -q
void detail(const std::string& line);   // with -v
void warning(const std::string& line);  // unless -q; "petzval: warning: …"
// Any of these, and failure().
void say(Say how, const std::string& line);
// Prints "petzval: …". Fields appear as their flags, or as they stand in a file.
enum class Words { Flags, Fields };
void failure(const std::string& line, Words words = Words::Flags);

// The text with control characters and invalid UTF-8 escaped, line breaks kept.
std::string printable(const std::string& text);
// The text with line breaks and other control characters made harmless: file names may hold anything.
std::string one_line(const std::string& text);

// Writes to standard output. Returns false if it could not be written (full disk, closed pipe).
bool print(const std::string& text);

// All words with `between` between them.
std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");

// A check that found something to doubt: exit code 5.
struct DoubtsFound {
    std::string message;
};

}  // namespace petzval::cli
