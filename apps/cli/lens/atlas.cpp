// petzval lens atlas: discs by place in the frame and by radius, for shaders (docs/reference/lens-atlas.md).
#include "petzval/lens_kernel.h"

#include "console/console.h"
#include "console/interrupt.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "guard.h"
#include "lens/mount.h"
#include "output.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

namespace petzval::cli {
namespace {

constexpr int kSide = 31, kRadii = 14;  // of a tile, texels; of a zone, half of them in front of focus

struct AtlasFlags : MountFlags {
    std::string folder;
    double largest_coc_px = 64;
    int zones = 5;
    OverwriteFlags overwrite;
    RunFlags run;

    std::string file(const char* name) const { return (std::filesystem::path(folder) / name).string(); }
};

// Light in 32 bits: nine of each colour, five of the exponent that they share, as Vulkan's
// E5B9G9R9_UFLOAT_PACK32 and WebGL's RGB9_E5 have it. Requires: r, g, b are finite. Negative light becomes 0.
class SharedExponent {
public:
    explicit SharedExponent(const Rgba& light) {
        std::array<float, 3> colour = {light.r, light.g, light.b};
        for (float& c : colour) c = std::clamp(c, 0.0f, 65408.0f);
        const float most = std::max({colour[0], colour[1], colour[2]});
        int exponent = std::max(-15, most > 0 ? std::ilogb(most) + 1 : -15);
        if (std::lround(std::ldexp(most, 9 - exponent)) > 511) ++exponent;
        for (int i = 0; i < 3; ++i) {
            const auto mantissa =
                std::uint32_t(std::lround(std::ldexp(colour[std::size_t(i)], 9 - exponent)));
            bits_ |= mantissa << (9 * i);
            stored_[std::size_t(i)] = std::ldexp(double(mantissa), exponent - 9);
        }
        bits_ |= std::uint32_t(exponent + 15) << 27;
    }
    std::uint32_t bits() const { return bits_; }
    const std::array<double, 3>& stored() const { return stored_; }

private:
    std::uint32_t bits_ = 0;
    std::array<double, 3> stored_ = {};
};

struct Atlas {
    std::string texels;             // little-endian words, row by row
    Json sides_px = Json::array();  // by zone, then radius: side of the square that a tile covers, pixels
    Json sums = Json::array();      // by zone, then radius: r, g, b of the disc
    std::vector<double> radii_px, places;
    std::string lens;
};

// Stores a disc as the tile of its zone and radius; texels hold light times their number, so that an even
// disc would be 1 everywhere. Returns the sums of the stored red, green and blue.
Json store(const Picture& disc, int zone, int radius, std::string& texels) {
    std::array<double, 3> sums = {};
    constexpr double kTexels = kSide * kSide;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const SharedExponent light(float(kTexels) * disc(x, y));
            for (std::size_t i = 0; i < 3; ++i) sums[i] += light.stored()[i] / kTexels;
            const int at = (zone * kSide + y) * kRadii * kSide + radius * kSide + x;
            for (int byte = 0; byte < 4; ++byte)
                texels[std::size_t(4 * at + byte)] = char(light.bits() >> (8 * byte) & 255u);
        }
    return {number(sums[0]), number(sums[1]), number(sums[2])};
}

// The disc on a picture of so many more pixels that `side_px` of the camera's picture fill a tile.
Result<LensDisc> tile_of(const MountedLens& mounted, double coc_px, double place, double side_px) {
    LensMount fine = mounted.mount;
    const double finer = kSide / side_px;
    fine.width_px = std::max(1, int(std::lround(fine.width_px * finer)));
    fine.height_px = std::max(1, int(std::lround(fine.height_px * finer)));
    return lens_point_spread(mounted.lens, fine, coc_px * fine.width_px / mounted.mount.width_px, place, 0,
                             kSide);
}

// A tile grows until at most this share of the light falls outside.
constexpr double kMostLost = 0.02;

Status add_tile(const MountedLens& mounted, double place, int zone, int radius, Atlas& atlas) {
    const double coc_px = atlas.radii_px[std::size_t(radius)];
    double side_px = std::max(4.0, std::abs(coc_px) / 0.35);
    auto disc = tile_of(mounted, coc_px, place, side_px);
    while (disc && disc->lost_share > kMostLost && side_px < kLargestDiscPx / 2.0)
        disc = tile_of(mounted, coc_px, place, side_px *= 1.3);
    if (!disc) return disc.error();
    atlas.lens = disc->lens;
    atlas.sides_px.back().push_back(number(side_px));
    atlas.sums.back().push_back(store(disc->weights, zone, radius, atlas.texels));
    return Done{};
}

Result<Atlas> make_atlas(const MountedLens& mounted, const AtlasFlags& flags) {
    Atlas atlas;
    atlas.texels.resize(std::size_t(4 * flags.zones * kSide * kRadii * kSide));
    for (int radius = 0; radius < kRadii; ++radius) {
        const double t = 2.0 * radius / (kRadii - 1) - 1;
        atlas.radii_px.push_back(flags.largest_coc_px * t * std::abs(t));
    }
    ProgressLine progress(flags.run.progress, flags.run.quiet, "lens atlas");
    for (int zone = 0; zone < flags.zones; ++zone) {
        atlas.places.push_back(flags.zones > 1 ? double(zone) / (flags.zones - 1) : 0);
        atlas.sides_px.push_back(Json::array());
        atlas.sums.push_back(Json::array());
        for (int radius = 0; radius < kRadii; ++radius) {
            if (interrupted_by() != 0 || !progress((zone + double(radius) / kRadii) / flags.zones))
                return Error{ErrorCode::Cancelled, "stopped"};
            if (Status done = add_tile(mounted, atlas.places.back(), zone, radius, atlas); !done)
                return done.error();
        }
    }
    progress(1);
    return atlas;
}

Json header_of(const Atlas& atlas, const MountedLens& mounted, const AtlasFlags& flags) {
    Json header;
    header["format"] = "petzval lens atlas";
    header["version"] = 1;
    header["name"] = flags.lens_name;
    header["lens"] = atlas.lens;
    header["camera"] = mount_json(mounted.mount);
    header["texels"] = {{"file", "atlas.bin"},
                        {"type", "rgb9e5"},
                        {"width", kRadii * kSide},
                        {"height", flags.zones * kSide}};
    header["tile"] = {{"side", kSide}};
    header["zones"] = atlas.places;
    header["radii_px"] = atlas.radii_px;
    header["sides_px"] = atlas.sides_px;
    header["sums"] = atlas.sums;
    return header;
}

Status write_atlas(AtlasFlags& flags) {
    const Stopwatch watch;
    const std::string header = flags.file("atlas.json"), texels = flags.file("atlas.bin");
    if (const auto reason = flags.overwrite.reason_to_skip({header, texels}, {})) {
        note(*reason);
        return Done{};
    }
    const auto mounted = flags.open();
    if (!mounted) return mounted.error();
    const auto atlas = make_atlas(*mounted, flags);
    if (!atlas) return atlas.error();
    if (const Status made = make_folder(flags.folder); !made) return made;
    for (const std::string& path : {header, texels}) run_files().writes(path);
    if (const Status fine = run_files().check(); !fine) return fine;
    const Json described = header_of(*atlas, *mounted, flags);
    // The header last: where it is, its texels are.
    if (const Status done = write_text(texels, atlas->texels); !done) return done;
    if (const Status done = write_text(header, report_text(described, -1)); !done) return done;
    note("wrote " + header + " and " + texels + ": " + atlas->lens + " (" +
         camera_text(mounted->mount.camera) + ")");
    if (flags.run.json.empty()) return Done{};
    Json report = new_report("lens atlas");
    report["output"] = header;
    report["outputs"] = {header, texels};
    report["lens"] = lens_json(flags.look.look(), atlas->lens);
    report["camera"] = described["camera"];
    report["radii_px"] = atlas->radii_px;
    report["seconds"]["total"] = watch.seconds();
    report["peak_memory_bytes"] = peak_memory_bytes();
    return write_report(report, flags.run.json);
}

// True for pupils that look different after a turn about the axis.
bool is_not_round(const LookRow& row) {
    for (const char* flag :
         {"--blades", "--blade-rotation", "--blade-curvature", "--iris-open", "--squeeze", "--barn-doors",
          "--aperture-image", "--kernel-image", "--dust", "--scratches", "--texture-seed"})
        if (row.flag == std::string(flag)) return true;
    return false;
}

void check(AtlasFlags& flags, const Verb& verb) {
    flags.run.apply();
    flags.overwrite.check();
    require_argument(verb, flags.folder, "-o FOLDER");
    flags.check_lens(verb);
    if (flags.zones > 64) throw UsageError("--zones " + std::to_string(flags.zones) + ": must be 1 to 64");
    for (const LookRow& row : look_rows()) {
        if (!flags.look.is_typed(row.field)) continue;
        if (flags.zones > 1 && is_not_round(row))
            throw UsageError(std::string(row.flag) +
                             " makes a pupil that is not round, and zones are rings that shaders turn about "
                             "the middle; give --zones 1");
        if (flags.zones == 1 && is_off_axis(row))
            throw UsageError(std::string(row.flag) +
                             " has no effect with --zones 1, the middle of the picture");
    }
}

}  // namespace

void add_lens_atlas(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "atlas", "discs by place in the frame and radius, as one texture for shaders",
                          "petzval lens atlas petzval-portrait -o portrait\n"
                          "petzval lens atlas doublet --blades 5 --zones 1 -o doublet");
    auto flags = std::make_shared<AtlasFlags>();
    flags->add_lens_to(verb);
    FlagGroup(verb, "Atlas")
        .value("--defocus", "PX", "signed radii from minus this to plus this (default 64)", parse_positive,
               flags->largest_coc_px)
        .value("--zones", "N", "rings of the frame from its middle to its corners, 1 to 64 (default 5)",
               parse_count, flags->zones);
    FlagGroup(verb, "Output")
        .value("-o,--output", "FOLDER", "for atlas.json and atlas.bin, made if missing", parse_text,
               flags->folder)
        .value("--width", "PX", "width of the picture that the camera takes (default 1920)", parse_size_px,
               flags->width_px)
        .value("--height", "PX", "its height (default 9/16 of the width)", parse_size_px, flags->height_px);
    flags->overwrite.add_to(verb, false);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, true);
    when_typed(verb, [flags, &verb, &chosen] {
        check(*flags, verb);
        chosen = [flags] { return write_atlas(*flags); };
    });
}

}  // namespace petzval::cli
