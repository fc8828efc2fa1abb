// Command lines, one word per line: read and checked, never run.
#include "flags/command_line.h"
#include "fuzz/held_file.h"
#include "guard.h"

#include <new>
#include <sstream>

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    std::istringstream text(std::string(reinterpret_cast<const char*>(bytes), size));
    std::vector<std::string> words{"petzval"};
    // A word of main() ends at its first zero byte.
    for (std::string word; words.size() < 64 && std::getline(text, word);) words.emplace_back(word.c_str());
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    petzval::cli::set_verbosity(petzval::cli::Verbosity::Quiet);
    petzval::cli::Typed typed;
    const auto chosen = petzval::cli::parsed(int(arguments.size()), arguments.data(), typed);
    petzval::cli::run_files() = {};
    if (!chosen) petzval::fuzz::check_message(petzval::cli::one_line(chosen.error().message));
    return 0;
}
