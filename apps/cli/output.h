// Outputs: names are checked before the work; the extension chooses the format.
#pragma once

#include "petzval/display_files.h"
#include "petzval/made_with.h"
#include "petzval/output.h"
#include "petzval/result.h"

#include "flags/flags.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

// Treatment of existing files.
struct OverwriteFlags {
    bool overwrite = false, no_clobber = false, update = false;

    void add_to(Verb& verb, bool with_update);
    void check() const;  // throws UsageError for contradictions
    ExistingOutputs existing() const;
    // Says why and returns true if all outputs exist and --no-clobber was given: no work is left.
    bool skips(const std::vector<std::string>& outputs) const;
};

// Settings from scene-linear light to a display picture; only for PNG.
struct DevelopFlags : DisplayChoice {
    void add_to(Verb& verb);
    // Throws UsageError for the first that was typed: `why` it has no effect ends the sentence.
    void refuse(const std::string& why) const;
};

// Throws UsageError if the output does not end in .png.
void require_png(const std::string& output);

// petzval::write_text(); "-" is standard output.
Status write_text(const std::string& path, const std::string& text);

// Throws UsageError (OutputFailed) if the folder of -o is a file.
void require_folder(const std::string& output);

}  // namespace petzval::cli
