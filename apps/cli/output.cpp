#include "output.h"

#include "console.h"
#include "fields.h"
#include "guard.h"
#include "values.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

namespace petzval::cli {
namespace {

namespace fs = std::filesystem;

}  // namespace

Result<FileKind> kind_of_output(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".exr") return FileKind::Exr;
    if (extension == ".png") return FileKind::Png;
    return Error{ErrorCode::InvalidArgument,
                 "-o " + path + ": the name must end in .exr or .png (standard output is -.exr or -.png)"};
}

void OverwriteFlags::add_to(Verb& verb, bool with_update) {
    FlagGroup group(verb, "Output");
    group.on("--overwrite", "replace existing files (default)", overwrite)
        .on("--no-clobber", "skip existing complete files, and succeed", no_clobber);
    if (with_update) group.on("-u,--update", "do nothing if the output is newer than all inputs", update);
}

void OverwriteFlags::check() const {
    refuse_both(overwrite, "--overwrite", no_clobber, "--no-clobber");
    refuse_both(update, "-u", no_clobber, "--no-clobber");
    if (no_clobber) never_replace();
}

std::optional<std::string> OverwriteFlags::reason_to_skip(const std::vector<std::string>& outputs,
                                                          const std::vector<std::string>& inputs) const {
    const OutputState there = state_of(outputs, inputs);
    return there.is_kept ? std::optional(in_flags(there.why)) : std::nullopt;
}

OutputState OverwriteFlags::state_of(const std::vector<std::string>& outputs,
                                     const std::vector<std::string>& inputs,
                                     const MadeWith* made_with) const {
    const ExistingOutputs existing = no_clobber ? ExistingOutputs::Keep
                                     : update   ? ExistingOutputs::Update
                                                : ExistingOutputs::Replace;
    return petzval::state_of(outputs, inputs, existing, made_with);
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

void DevelopFlags::add_to(MadeWith& made) const {
    made.add("develop.exposure_stops", exposure_stops);
    made.add("develop.contrast", contrast);
    if (tone) made.add("develop.tone", name_of(*tone));
    if (bits != 8) made.add("develop.bits", double(bits));
}

DevelopSettings DevelopFlags::settings(bool display_referred, std::optional<Transfer> transfer,
                                       int threads) const {
    return {.exposure_stops = exposure_stops.value_or(0),
            .contrast = contrast.value_or(1),
            .tone = tone.value_or(display_referred ? ToneCurve::None : ToneCurve::Filmic),
            .transfer = transfer.value_or(Transfer::Srgb),
            .bits = bits,
            .threads = threads};
}

Status write_codes(const std::string& path, int width, int height, std::vector<std::uint16_t> codes, int bits,
                   bool overwrite, double pixel_aspect, PngTexts texts) {
    return write_png(path,
                     {.width = width,
                      .height = height,
                      .channels = 3,
                      .bits = bits,
                      .samples = std::move(codes),
                      .pixel_aspect = pixel_aspect,
                      .texts = std::move(texts)},
                     overwrite);
}

Status write_developed(const std::string& path, View<const Rgba> picture, const DevelopSettings& settings,
                       bool overwrite, double pixel_aspect, PngTexts texts) {
    return write_codes(path, picture.width(), picture.height(), develop(picture, settings), settings.bits,
                       overwrite, pixel_aspect, std::move(texts));
}

Status write_grey_png(const std::string& path, View<const float> plane, bool overwrite, PngTexts texts) {
    PngPixels grey{.width = plane.width(),
                   .height = plane.height(),
                   .channels = 1,
                   .bits = 16,
                   .samples = {},
                   .pixel_aspect = 1,
                   .texts = std::move(texts)};
    grey.samples.reserve(std::size_t(plane.width()) * std::size_t(plane.height()));
    for (int y = 0; y < plane.height(); ++y)
        for (int x = 0; x < plane.width(); ++x) {
            const float value = plane(x, y) > 0 ? std::min(plane(x, y), 1.0f) : 0.0f;
            grey.samples.push_back(std::uint16_t(std::lround(65535 * value)));
        }
    return write_png(path, grey, overwrite);
}

Status write_text(const std::string& path, const std::string& text) {
    if (path != "-") return is_left_alone(path) ? Status(Done{}) : petzval::write_text(path, text);
    if (print(text)) return Done{};
    return Error{ErrorCode::OutputFailed,
                 std::string("cannot write standard output: ") + std::strerror(errno)};
}

}  // namespace petzval::cli
