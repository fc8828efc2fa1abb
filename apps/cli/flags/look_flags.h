// The look of a command: its file, and the flags of look_rows.h over it.
#pragma once

#include "petzval/look.h"

#include "flags/flags.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

using Headings = std::vector<std::string>;
struct LookRow;

class LookFlags {
public:
    // Rows that change nothing in a verb: no help names them, and `why` ends the sentence that refuses them.
    struct Idle {
        std::function<bool(const LookRow&)> holds;
        std::string why;
    };
    // The rows under these headings; `without`, for a verb that takes one of them as an argument.
    void add_to(Verb& verb, const Headings& headings, const std::string& without = "", const Idle& idle = {});
    void add_files_to(Verb& verb);  // --look, --save-look

    // Reads --look and applies the flags on top. Throws UsageError for a file that is not a look, for
    // contradictions, and for flags without effect.
    void settle();

    // The look before and after settle(). read_lens_images() reads the pictures of apertures and discs.
    const Look& look() const { return look_; }
    Look& look() { return look_; }
    // Sentences about fields of the look file without effect: one look serves drafts and final frames.
    const std::vector<std::string>& idle_in_file() const { return idle_in_file_; }
    bool is_typed(const std::string& field) const;
    // Flags under these headings that were typed, for messages.
    std::vector<std::string> given(const Headings& headings) const;
    // Files that are read: a look, a lens, pictures.
    std::vector<std::string> input_files() const;
    const std::string& save_to() const { return save_to_; }
    const std::string& file() const { return file_; }  // of --look; empty: none
    // Options of one engine given on the command line, by flag: {"gather_taps": 16}.
    std::string engine_options_json() const;

private:
    void apply(const std::string& field, const std::string& json);

    std::map<std::string, std::optional<std::string>> texts_;  // JSON by field
    std::map<std::string, std::optional<bool>> switches_;
    std::map<std::string, std::string> idle_;  // by field, why it is refused
    std::string file_, preset_, save_to_;
    Look look_;
    std::vector<std::string> idle_in_file_;
};

}  // namespace petzval::cli
