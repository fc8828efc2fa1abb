#include "lens_files/lens_file.h"

#include "base/content_hash.h"
#include "base/whole_file.h"
#include "lens_files/readers.h"

#include <filesystem>
#include <sstream>

namespace petzval::lens_files {
namespace {

Error named(const std::string& name, const Error& error) { return {error.code, name + ": " + error.message}; }

bool starts_with_keyword(const std::vector<Line>& lines, const std::set<std::string>& keywords, int among) {
    int seen = 0;
    for (const Line& line : lines) {
        const auto words = split_words(line.text);
        if (words.empty() || words[0].front() == '!') continue;
        const std::string first(words[0].substr(0, words[0].find(';')));
        if (keywords.contains(upper_case(first))) return true;
        if (++seen == among) return false;
    }
    return false;
}

// The first line that is not blank or a '#' comment: numbers in a pbrt lens.
bool begins_with_numbers(const std::vector<Line>& lines) {
    for (const Line& line : lines) {
        const auto words = split_words(line.text.substr(0, line.text.find('#')));
        if (words.empty()) continue;
        for (const auto word : words)
            if (!parse_number(word)) return false;
        return words.size() > 1;
    }
    return false;
}

bool has_section(const std::vector<Line>& lines, std::string_view section) {
    for (const Line& line : lines)
        if (upper_case(trimmed(line.text)) == section) return true;
    return false;
}

Result<LensFile> read_any(const std::string& text) {
    const std::vector<Line> lines = split_lines(text);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return Error{ErrorCode::InvalidFile, "the file is empty"};
    if (text[first] == '{') return read_json_lens(text);
    if (has_section(lines, "[LENS DATA]")) return read_optical_bench(text);
    if (starts_with_keyword(lines, {"VERS", "MODE", "SURF", "UNIT", "ENPD", "FNUM"}, 12))
        return read_zmx(text);
    if (starts_with_keyword(lines, {"RDM", "LEN", "SO", "TIT", "TITLE", "EPD", "DIM", "WL", "S"}, 12))
        return read_seq(text);
    const std::string table = table_text(text);
    if (is_table(split_lines(table))) return read_table(table);
    if (begins_with_numbers(lines)) return read_pbrt(text);
    return Error{ErrorCode::InvalidFile,
                 "line 1: not a lens file; JSON, Zemax .zmx, CODE V .seq, pbrt .dat, "
                 "Optical Bench text and tables of surfaces are read"};
}

}  // namespace

Result<LensFile> read_lens(std::string_view bytes, const std::string& name) {
    if (bytes.size() > kLargestLensFile) {
        std::ostringstream text;
        text << name << ": " << bytes.size() << " bytes are too many for a lens; " << kLargestLensFile
             << " are read at most";
        return Error{ErrorCode::InvalidFile, text.str()};
    }
    auto file = read_any(decode_text(bytes));
    if (!file) return named(name, file.error());
    const Status status = file->curves ? optics::check(*file->curves) : optics::check(file->lens);
    if (!status) return Error{ErrorCode::InvalidFile, name + ": " + status.error().message};
    if (file->lens.name.empty())
        file->lens.name = file->lens.id.empty() ? std::filesystem::path(name).stem().string() : file->lens.id;
    if (file->lens.id.empty()) file->lens.id = std::filesystem::path(name).stem().string();
    file->content_key = ContentHash().add(bytes).text();
    if (file->curves) file->curves->name = file->lens.id, file->curves->description = file->lens.name;
    return file;
}

Result<LensFile> load_lens_file(const std::string& path) {
    std::error_code problem;
    if (std::filesystem::is_directory(path, problem))
        return Error{ErrorCode::InvalidFile, path + ": a folder, not a lens file"};
    // Pipes and devices may never answer.
    if (std::filesystem::exists(path, problem) && !std::filesystem::is_regular_file(path, problem))
        return Error{ErrorCode::InvalidFile,
                     path + ": a pipe or a device, not a lens file; lenses are read from regular files"};
    const auto bytes = text_of_file(path, kLargestLensFile);
    return bytes ? read_lens(*bytes, path) : bytes.error();
}

}  // namespace petzval::lens_files
