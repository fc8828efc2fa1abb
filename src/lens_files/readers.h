// Shared parts of this room's readers; one reader per format.
#pragma once

#include "lens_files/glass_catalogue.h"
#include "lens_files/json.h"
#include "lens_files/lens_file.h"
#include "lens_files/text.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace petzval::lens_files {

// Each returns errors "line N: …"; read_lens puts the file's name in front.
Result<LensFile> read_json_lens(const std::string& text);
Result<LensFile> read_json_lens(const Json& root);
// Reads an object with "curves"; `lens` is left empty.
Result<LensFile> read_json_curves(const Json& root);
Result<LensFile> read_zmx(const std::string& text);
Result<LensFile> read_seq(const std::string& text);
Result<LensFile> read_pbrt(const std::string& text);
Result<LensFile> read_optical_bench(const std::string& text);
// The text without comments, with typographer's signs and separators replaced by plain ones: what is_table()
// and read_table() take.
std::string table_text(const std::string& text);
// True if these lines are rows of surfaces as patents print them, and no pbrt lens.
bool is_table(const std::vector<Line>& lines);
// Requires: is_table() of its lines.
Result<LensFile> read_table(const std::string& text);

inline Error at_line(int line, const std::string& what) {
    return {ErrorCode::InvalidFile, "line " + std::to_string(line) + ": " + what};
}

// The reader's answer to a glass the file names.
struct GlassRequest {
    std::string name;              // as written, may be empty
    std::string maker;             // as written, may be empty
    std::optional<double> nd, vd;  // a model the file gives beside the name
    int line = 0;
};
// The catalogue's glass of that name; else the model, which is reported; else an error that names near
// misses. A maker other than the catalogue's is reported too.
class GlassFinder {
public:
    GlassFinder() = default;
    // `own`: glasses the file brings along, which come first.
    explicit GlassFinder(optics::GlassCatalogue own) : own_(std::move(own)) {}

    Result<optics::Glass> find(const GlassRequest& request);
    void report(std::vector<std::string>& warnings) const;

private:
    optics::GlassCatalogue own_;
    std::set<std::string> modelled_, other_makers_;
};

// Words the reader knows to be harmless, collected into one warning.
class Ignored {
public:
    void add(const std::string& word) { words_.insert(word); }
    void report(std::vector<std::string>& warnings) const;

private:
    std::set<std::string> words_;
};

// Surfaces whose glass is only (nd, Vd), or has no dispersion at all, as one warning each; sets
// dispersion_known.
void warn_of_models(LensFile& file);

// A field for formats that state none: the half diagonal of a 36 x 24 mm picture, said in a warning.
void assume_field(LensFile& file);

}  // namespace petzval::lens_files
