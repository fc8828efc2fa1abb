// A table of surfaces as patents and books print it, pasted as text: one row per surface from the front.
//
//   [number] radius thickness [glass | nd [Vd]] [clear DIAMETER, or semi-diameter by the heading] [stop]
//
// Columns are parted by tabs, commas, semicolons, bars or blanks; a comma between digits in a line with tabs,
// semicolons or bars, and without points, is a decimal comma. ∞, "inf", "plano" and 0 are flat; "air", 1
// or nothing is air. The heading may state "f = 50" and "F/2". Every guess is a warning.
#include "lens_files/readers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::lens_files {
namespace {

struct Row {
    int line = 0;
    std::vector<std::string_view> words;  // without the mark of the stop
    bool is_stop = false;
};

bool is_word_of(std::string_view word, std::initializer_list<std::string_view> list) {
    const std::string upper = upper_case(word);
    return std::find(list.begin(), list.end(), upper) != list.end();
}

bool marks_stop(std::string_view word) {
    return is_word_of(word, {"STOP", "STO", "(STOP)", "DIAPHRAGM", "APERTURE", "*"});
}

bool marks_object_or_image(std::string_view word) {
    return is_word_of(word, {"OBJ", "OBJECT", "IMA", "IMAGE", "IMG"});
}

bool is_flat(std::string_view word) { return is_word_of(word, {"PLANO", "PLAN", "PLANE", "FLAT"}); }

std::optional<double> radius_of(std::string_view word) {
    return is_flat(word) ? std::optional<double>(0) : parse_number(word);
}

// The row of a line that begins with a radius and a thickness, or is a stop; none for headings and notes.
std::optional<Row> row_of(const Line& line) {
    Row row{line.number, {}, false};
    for (const std::string_view word : split_words(line.text))
        if (marks_object_or_image(word))
            return std::nullopt;
        else if (marks_stop(word))
            row.is_stop = true;
        else
            row.words.push_back(word);
    const auto& words = row.words;
    const bool is_surface = words.size() >= 2 && radius_of(words[0]) && radius_of(words[1]);
    const bool is_bare_stop = row.is_stop && !words.empty() && parse_number(words[0]);
    return is_surface || is_bare_stop ? std::optional(row) : std::nullopt;
}

std::vector<Row> rows_of(const std::vector<Line>& lines) {
    std::vector<Row> rows;
    for (const Line& line : lines)
        if (auto row = row_of(line)) rows.push_back(std::move(*row));
    return rows;
}

// A surface that is left out makes another lens, so lines with many numbers must be rows. A heading may state
// a focal length and an f-number. A line of one number below the rows is a last radius.
Status check_other_lines(const std::vector<Line>& lines, const std::vector<Row>& rows) {
    for (const Line& line : lines) {
        const auto words = split_words(line.text);
        if (row_of(line) || std::any_of(words.begin(), words.end(), marks_object_or_image)) continue;
        const auto is_number = [](std::string_view word) { return parse_number(word).has_value(); };
        const auto numbers = std::count_if(words.begin(), words.end(), is_number);
        const bool is_radius = numbers == 1 && words.size() == 1 && line.number > rows.front().line;
        if (numbers >= (line.number < rows.front().line ? 3 : 2) || is_radius)
            return at_line(line.number,
                           "is not a row: one begins with radius and thickness, as numbers; put # "
                           "before notes");
    }
    return Done{};
}

bool has_digit(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Lines below the rows, such as coefficients of aspheres, are named.
void warn_of_lines_below(LensFile& file, const std::vector<Line>& lines, int last_row) {
    for (const Line& line : lines)
        if (line.number > last_row && has_digit(line.text))
            file.warnings.push_back("line " + std::to_string(line.number) +
                                    " below the table is not read: " + quoted(trimmed(line.text)));
}

// The unit that a heading puts into brackets or behind "in", other than millimetres; empty if there is none.
std::string_view other_unit(std::string_view heading) {
    constexpr std::string_view kMarks = "()[],.:";
    bool is_behind_in = false;
    for (std::string_view word : split_words(heading)) {
        const std::size_t bracket = word.find_first_of("([");  // "r[cm]"
        const bool in_brackets = bracket != std::string_view::npos;
        if (in_brackets) word.remove_prefix(bracket + 1);
        while (!word.empty() && kMarks.find(word.back()) != std::string_view::npos) word.remove_suffix(1);
        if ((in_brackets || is_behind_in) &&
            (word == "m" || is_word_of(word, {"CM", "IN", "INCH", "INCHES", "CENTIMETRES", "CENTIMETERS"})))
            return word;
        is_behind_in = is_word_of(word, {"IN"});
    }
    return "";
}

Status check_unit(const std::vector<Line>& lines, int first_row) {
    for (const Line& line : lines) {
        if (line.number >= first_row) break;
        if (const std::string_view unit = other_unit(line.text); !unit.empty())
            return at_line(line.number, "lengths in " + quoted(unit) +
                                            " are not read; convert them to mm and remove the unit");
    }
    return Done{};
}

// Numbers of surfaces in front, 1, 2, 3, …, are taken away. A row of the stop may have none, whether the
// numbers count it or not.
void drop_numbers(std::vector<Row>& rows) {
    std::vector<bool> is_numbered;
    double next = 1;
    bool may_skip = false;
    for (const Row& row : rows) {
        const auto number = row.words.size() < 2 ? std::nullopt : parse_number(row.words[0]);
        const bool is_next = number && (*number == next || (may_skip && *number == next + 1));
        if (!is_next && !row.is_stop) return;
        if (is_next) next = *number + 1;
        may_skip = !is_next;
        is_numbered.push_back(is_next);
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (is_numbered[i]) rows[i].words.erase(rows[i].words.begin());
}

// The number behind the first of these marks in the heading, as "f = 50" or "F/2"; 0 if there is none.
double stated(const std::vector<Line>& lines, int first_row, std::initializer_list<std::string_view> marks) {
    for (const Line& line : lines) {
        if (line.number >= first_row) break;
        std::string joined;  // "f = 50" as "f=50"
        for (const char c : line.text)
            if (c != ' ' || joined.empty() || (joined.back() != '=' && joined.back() != '/')) joined += c;
        for (std::size_t at = joined.find(" ="); at != std::string::npos; at = joined.find(" ="))
            joined.erase(at, 1);
        for (const std::string_view word : split_words(joined))
            for (const std::string_view mark : marks)
                if (word.starts_with(mark))
                    if (const auto number = parse_number(word.substr(mark.size())); number && *number > 0)
                        return *number;
    }
    return 0;
}

class TableReader {
public:
    // semi: the last column holds semi-diameters.
    TableReader(LensFile& file, bool semi) : file_(file), diameters_(semi ? 2 : 1) {}

    Status add(const Row& row, bool is_last) {
        if (file_.lens.surfaces.size() >= std::size_t(optics::kMostSurfaces))
            return at_line(row.line, "more than " + std::to_string(optics::kMostSurfaces) + " surfaces");
        optics::Surface surface;
        std::size_t at = 0;
        if (row.words.size() > 1 || !row.is_stop) {  // a stop may have only the distance behind it
            const double radius = *radius_of(row.words[at++]);
            surface.curvature_per_mm = radius == 0 ? 0 : 1 / radius;
        }
        // A table need not state the distance behind its last surface, or may name it in a word.
        const auto thickness = at < row.words.size() ? radius_of(row.words[at++]) : std::nullopt;
        if (!is_last && (!thickness || !std::isfinite(*thickness)))
            return at_line(row.line, "the thickness is not a finite number");
        surface.thickness_mm = thickness.value_or(0);
        if (const Status glass = take_medium(row, at, surface); !glass) return glass;
        if (at < row.words.size()) {
            const auto diameter = parse_number(row.words[at]);
            if (!diameter || !(*diameter > 0))
                return at_line(row.line, quoted(row.words[at]) + " is neither a glass nor a diameter");
            surface.clear_radius_mm = *diameter * diameters_ / 2;
            ++at;
        }
        if (at < row.words.size())
            return at_line(row.line, quoted(row.words[at]) +
                                         " was not expected; a row holds radius, thickness, glass or nd "
                                         "and Vd, and clear diameter");
        if (row.is_stop && has_stop_) return at_line(row.line, "a second stop");
        if (row.is_stop) file_.lens.stop = int(file_.lens.surfaces.size()), has_stop_ = true;
        file_.lens.surfaces.push_back(surface);
        return Done{};
    }

    // A stop that no row marks stands in the middle of the widest gap of air.
    void guess_stop() {
        if (has_stop_) return;
        auto& surfaces = file_.lens.surfaces;
        std::size_t widest = surfaces.size();
        for (std::size_t i = 0; i + 1 < surfaces.size(); ++i)
            if (surfaces[i].after.is_air() && surfaces[i].thickness_mm > 0 &&
                (widest == surfaces.size() || surfaces[i].thickness_mm > surfaces[widest].thickness_mm))
                widest = i;
        if (widest == surfaces.size()) {
            file_.lens.stop = 0;
            file_.warnings.emplace_back("no row is marked as the stop; the first surface is taken");
            return;
        }
        optics::Surface stop;
        stop.thickness_mm = surfaces[widest].thickness_mm /= 2;
        surfaces.insert(surfaces.begin() + std::ptrdiff_t(widest) + 1, stop);
        file_.lens.stop = int(widest) + 1;
        file_.warnings.push_back(
            "no row is marked as the stop; it is put into the middle of the widest air gap, behind surface " +
            std::to_string(widest + 1));
    }

    void report() const { glasses_.report(file_.warnings); }

private:
    Status take_medium(const Row& row, std::size_t& at, optics::Surface& surface) {
        if (at == row.words.size()) return Done{};
        const auto index = parse_number(row.words[at]);
        if (!index) {
            const std::string_view name = row.words[at++];
            if (upper_case(name) == "AIR") return Done{};
            auto glass = glasses_.find({std::string(name), "", std::nullopt, std::nullopt, row.line});
            if (!glass) return glass.error();
            surface.after = *glass;
        } else if (*index >= 1 && *index < 2.2) {
            ++at;
            const auto abbe = at < row.words.size() ? parse_number(row.words[at]) : std::nullopt;
            const bool has_abbe = *index > 1.001 && abbe && *abbe >= 10 && *abbe <= 100;
            if (has_abbe) ++at;
            if (*index > 1.001)
                surface.after =
                    has_abbe ? optics::abbe_glass("", *index, *abbe) : optics::constant_glass("", *index);
        }
        return Done{};
    }

    LensFile& file_;
    double diameters_;  // per number of the last column
    GlassFinder glasses_;
    bool has_stop_ = false;
};

// True if the heading of the columns says semi-diameter or semi-aperture.
bool heads_semi(const std::vector<Line>& lines, int first_row) {
    for (const Line& line : lines) {
        if (line.number >= first_row) break;
        std::string letters;
        for (const char c : upper_case(line.text))
            if (c >= 'A' && c <= 'Z') letters += c;
        if (letters.find("SEMIDIA") != std::string::npos || letters.find("SEMIAPE") != std::string::npos)
            return true;
    }
    return false;
}

Status set_aperture(optics::Prescription& lens, double f_number) {
    const double stop_radius = lens.surfaces[std::size_t(lens.stop)].clear_radius_mm;
    if (!(f_number > 0) && !std::isfinite(stop_radius))
        return Error{ErrorCode::InvalidFile,
                     "the table states neither an f-number nor the stop's diameter; put \"F/2.8\" above it"};
    lens.aperture_kind = f_number > 0 ? optics::ApertureKind::FNumber : optics::ApertureKind::StopRadius;
    lens.aperture = f_number > 0 ? f_number : stop_radius;
    return Done{};
}

}  // namespace

// A table needs words: those of an f-number or of the stop. A pbrt lens is numbers alone.
bool is_table(const std::vector<Line>& lines) {
    const auto is_number = [](std::string_view word) { return parse_number(word).has_value(); };
    bool has_words = false;
    for (const Line& line : lines) {
        const auto words = split_words(line.text);
        has_words = has_words || !std::all_of(words.begin(), words.end(), is_number);
    }
    return has_words && rows_of(lines).size() > 1;
}

namespace {

// Makes points of decimal commas.
void point_decimals(std::string& text) {
    const auto digits_around = [&](std::size_t at) {
        const auto is_digit = [&](std::size_t i) {
            return i < text.size() && text[i] >= '0' && text[i] <= '9';
        };
        return at > 0 && is_digit(at - 1) && is_digit(at + 1);
    };
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
        end = std::min(text.find_first_of("\r\n", begin), text.size());
        bool has_other_columns = false, has_points = false;
        for (std::size_t at = begin; at < end; ++at) {
            has_other_columns = has_other_columns || text[at] == '\t' || text[at] == ';' || text[at] == '|';
            has_points = has_points || (text[at] == '.' && digits_around(at));
        }
        if (!has_other_columns || has_points) continue;
        for (std::size_t at = begin; at < end; ++at)
            if (text[at] == ',' && digits_around(at)) text[at] = '.';
    }
}

}  // namespace

std::string table_text(const std::string& text) {
    // Infinity; minus, hyphen, non-breaking hyphen, en dash; no-break space.
    const std::array<std::array<std::string_view, 2>, 6> signs{{{"\xE2\x88\x9E", " inf "},
                                                                {"\xE2\x88\x92", "-"},
                                                                {"\xE2\x80\x90", "-"},
                                                                {"\xE2\x80\x91", "-"},
                                                                {"\xE2\x80\x93", "-"},
                                                                {"\xC2\xA0", " "}}};
    std::string plain = text;
    for (const auto& [sign, word] : signs)
        for (std::size_t at = plain.find(sign); at != std::string::npos;
             at = plain.find(sign, at + word.size()))
            plain.replace(at, sign.size(), word);
    point_decimals(plain);
    bool in_comment = false;
    for (char& c : plain) {
        in_comment = c != '\n' && c != '\r' && (in_comment || c == '#');
        if (in_comment || c == ',' || c == ';' || c == '|' || c == '\t') c = ' ';
    }
    return plain;
}

Result<LensFile> read_table(const std::string& text) {
    LensFile file;
    file.format = "table of surfaces";
    const std::vector<Line> lines = split_lines(text);
    std::vector<Row> rows = rows_of(lines);
    const int first_row = rows.front().line;
    if (const Status complete = check_other_lines(lines, rows); !complete) return complete.error();
    if (const Status metric = check_unit(lines, first_row); !metric) return metric.error();
    warn_of_lines_below(file, lines, rows.back().line);
    drop_numbers(rows);
    const bool semi = heads_semi(lines, first_row);
    if (semi) file.warnings.emplace_back("the last column is taken as semi-diameters, as the heading says");
    TableReader reader(file, semi);
    for (const Row& row : rows)
        if (const Status added = reader.add(row, &row == &rows.back()); !added) return added.error();
    reader.guess_stop();
    const double f_number = stated(lines, first_row, {"F/", "f/", "F=", "FNO=", "Fno=", "F-number="});
    if (const Status aperture = set_aperture(file.lens, f_number); !aperture) return aperture.error();
    reader.report();
    warn_of_models(file);
    assume_field(file);
    file.printed_focal_length_mm = stated(lines, first_row, {"f=", "EFL=", "efl="});
    file.printed_f_number = f_number;
    return file;
}

}  // namespace petzval::lens_files
