#include "output.h"

#include "console/console.h"
#include "flags/fields.h"
#include "flags/values.h"
#include "guard.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace petzval::cli {

void OverwriteFlags::add_to(Verb& verb, bool with_update) {
    FlagGroup group(verb, "Output");
    group.on("--overwrite", "replace existing files (default)", overwrite)
        .on("--no-clobber", "skip existing complete files, and succeed", no_clobber);
    if (with_update)
        group.on("-u,--update", "skip outputs that are newer than all inputs and have the same settings",
                 update);
}

void OverwriteFlags::check() const {
    refuse_both(overwrite, "--overwrite", no_clobber, "--no-clobber");
    refuse_both(update, "-u", no_clobber, "--no-clobber");
    if (no_clobber) never_replace();
}

bool OverwriteFlags::skips(const std::vector<std::string>& outputs) const {
    const OutputState there = state_of(outputs, {}, existing());
    if (!there.is_kept) return false;
    note(there.why);
    for (const std::string& line : damage_of_kept(outputs)) warning(line);
    return true;
}

ExistingOutputs OverwriteFlags::existing() const {
    return no_clobber ? ExistingOutputs::Keep : update ? ExistingOutputs::Update : ExistingOutputs::Replace;
}

void DevelopFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Display picture (PNG)")
        .value("--exposure", "STOPS", "brighten by this many stops, such as 1.5 or -2", parse_number,
               exposure_stops)
        .value("--contrast", "FACTOR", "exponent around mid-grey, such as 1.2; 1 is neutral (default)",
               parse_positive, contrast)
        .choice<ToneCurve>("--tone",
                           "tone curve: filmic, keeps mid-grey and hue, rolls off highlights (default; none "
                           "for PNG input); reinhard, n/(1 + n); none, clip",
                           tone);
}

void DevelopFlags::refuse(const std::string& why) const {
    for (const auto& [name, given] : {std::pair{"--exposure", exposure_stops.has_value()},
                                      {"--contrast", contrast.has_value()},
                                      {"--tone", tone.has_value()}})
        if (given) throw UsageError(std::string(name) + " " + why);
}

void require_png(const std::string& output) {
    const auto kind = kind_of_output(output);
    if (!kind || *kind != FileKind::Png) throw UsageError("-o " + output + ": the name must end in .png");
}

Status write_text(const std::string& path, const std::string& text) {
    if (path != "-") return is_left_alone(path) ? Status(Done{}) : petzval::write_text(path, text);
    if (print(text)) return Done{};
    return Error{ErrorCode::OutputFailed,
                 std::string("cannot write standard output: ") + std::strerror(errno)};
}

void require_folder(const std::string& output) {
    std::error_code unknown;
    if (std::filesystem::exists(output, unknown) && !std::filesystem::is_directory(output, unknown))
        throw UsageError("-o " + output + ": must be a folder, but is a file", ErrorCode::OutputFailed);
}

}  // namespace petzval::cli
