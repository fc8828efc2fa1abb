// Outputs: names are checked before the work; the extension chooses the format.
#pragma once

#include "petzval/develop.h"
#include "petzval/files.h"
#include "petzval/made_with.h"
#include "petzval/output.h"
#include "petzval/result.h"

#include "flags.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

enum class FileKind { Exr, Png };

// The format by extension. Errors: InvalidArgument naming the accepted extensions.
Result<FileKind> kind_of_output(const std::string& path);

// Treatment of existing files.
struct OverwriteFlags {
    bool overwrite = false, no_clobber = false, update = false;

    void add_to(Verb& verb, bool with_update);
    void check() const;  // throws UsageError for contradictions
    // A line that says why nothing needs to be done, or nothing: all outputs exist and --no-clobber, or all
    // are newer than all inputs and -u.
    std::optional<std::string> reason_to_skip(const std::vector<std::string>& outputs,
                                              const std::vector<std::string>& inputs) const;
    // The same, with the reason why -u renders an existing output again.
    OutputState state_of(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                         const MadeWith* made_with = nullptr) const;
};

// Settings from scene-linear light to a display picture; only for PNG.
struct DevelopFlags {
    std::optional<double> exposure_stops;
    std::optional<double> contrast;
    std::optional<ToneCurve> tone;
    int bits = 8;

    void add_to(Verb& verb);
    // A picture that was display-referred keeps its look unless told otherwise.
    void add_to(MadeWith& made) const;
    DevelopSettings settings(bool display_referred, std::optional<Transfer> transfer, int threads) const;
};

// Text chunks of a PNG.
using PngTexts = std::vector<std::pair<std::string, std::string>>;
// Codes of develop(). pixel_aspect: of the file's pixels, where they are not square. Errors: OutputFailed.
Status write_codes(const std::string& path, int width, int height, std::vector<std::uint16_t> codes, int bits,
                   bool overwrite, double pixel_aspect = 1, PngTexts texts = {});
// Developed, the same.
Status write_developed(const std::string& path, View<const Rgba> picture, const DevelopSettings& settings,
                       bool overwrite, double pixel_aspect = 1, PngTexts texts = {});
// A plane as 16-bit grey: 0…1 becomes 0…65535, anything else the nearer end, NaN 0.
Status write_grey_png(const std::string& path, View<const float> plane, bool overwrite, PngTexts texts = {});
// petzval::write_text(); "-" is standard output.
Status write_text(const std::string& path, const std::string& text);

}  // namespace petzval::cli
