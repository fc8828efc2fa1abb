#include "flags/values.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace petzval::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Error no(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

// A number at the front of the text, and the rest.
struct Split {
    double number = 0;
    std::string rest;
};

std::optional<Split> split(const std::string& text) {
    Split result;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, result.number);
    if (failure != std::errc{} || std::isnan(result.number)) return std::nullopt;
    result.rest.assign(stop, end);
    return result;
}

std::optional<double> whole_number(const std::string& text) {
    const auto parts = split(text);
    return parts && parts->rest.empty() ? std::optional(parts->number) : std::nullopt;
}

// Millimetres per unit; 0 if the unit is not known.
double unit_in_mm(const std::string& unit) {
    struct Unit {
        const char* name;
        double mm;
    };
    static constexpr std::array<Unit, 8> units{{{"mm", 1},
                                                {"cm", 10},
                                                {"m", 1000},
                                                {"km", 1e6},
                                                {"in", 25.4},
                                                {"\"", 25.4},
                                                {"ft", 304.8},
                                                {"'", 304.8}}};
    for (const Unit& known : units)
        if (unit == known.name) return known.mm;
    return 0;
}

// Millimetres of "7ft6in"; 0 if the text is not a length in feet.
double feet_and_inches_mm(const Split& feet) {
    const std::size_t digit = feet.rest.find_first_of("0123456789");
    if (digit == std::string::npos || unit_in_mm(feet.rest.substr(0, digit)) != unit_in_mm("ft")) return 0;
    const auto inches = split(feet.rest.substr(digit));
    const bool fine = inches && unit_in_mm(inches->rest) == unit_in_mm("in") && feet.number >= 0;
    return fine ? feet.number * unit_in_mm("ft") + inches->number * unit_in_mm("in") : 0;
}

// Divides last, so that "2500mm" is 2.5 to the last bit.
Result<double> parse_length(const std::string& text, const std::string& bare_unit) {
    const auto parts = split(text);
    if (const double mm = parts ? feet_and_inches_mm(*parts) : 0; mm > 0) return mm / unit_in_mm(bare_unit);
    const double unit = parts ? unit_in_mm(parts->rest.empty() ? bare_unit : parts->rest) : 0;
    if (unit == 0)
        return no("not a length; write 85mm, 120cm, 2.5m, 8ft or 7ft6in (a bare number is in " + bare_unit +
                  ")");
    if (!(parts->number > 0)) return no("must be more than 0");
    return parts->number * unit / unit_in_mm(bare_unit);
}

std::optional<std::pair<std::string, std::string>> split_at_comma(const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos) return std::nullopt;
    return std::pair(text.substr(0, comma), text.substr(comma + 1));
}

Result<int> parse_integer(const std::string& text, int low, int high, const std::string& accepted) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    if (failure != std::errc{} || stop != end || value < low || value > high)
        return no("must be " + accepted);
    return value;
}

std::vector<std::string> split_at(const std::string& text, char at) {
    std::vector<std::string> parts{""};
    for (const char c : text)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

}  // namespace

Result<double> parse_number(const std::string& text) {
    const auto number = whole_number(text);
    return number ? Result<double>(*number) : no("not a number");
}

Result<double> parse_positive(const std::string& text) {
    const auto number = whole_number(text);
    return number && *number > 0 ? Result<double>(*number) : no("must be a number above 0");
}

Result<double> parse_not_negative(const std::string& text) {
    const auto number = whole_number(text);
    return number && *number >= 0 && *number < kInfinity ? Result<double>(*number)
                                                         : no("must be a number of 0 or more");
}

Result<double> parse_share(const std::string& text) {
    const auto number = whole_number(text);
    return number && *number >= 0 && *number <= 1 ? Result<double>(*number)
                                                  : no("must be a number from 0 to 1");
}

Result<double> parse_f_number(const std::string& text) {
    const bool spelled = text.size() > 2 && (text[0] == 'f' || text[0] == 'F') && text[1] == '/';
    const auto number = whole_number(spelled ? text.substr(2) : text);
    return number && *number > 0 ? Result<double>(*number)
                                 : no("must be an f-number above 0, such as 2.8 or f/2.8");
}

Result<double> parse_length_mm(const std::string& text) { return parse_length(text, "mm"); }
Result<double> parse_length_m(const std::string& text) { return parse_length(text, "m"); }

Result<Interval> parse_range(const std::string& text) {
    const auto parts = split_at_comma(text);
    const auto low = parts ? whole_number(parts->first) : std::nullopt;
    const auto high = parts ? whole_number(parts->second) : std::nullopt;
    if (!low || !high) return no("must be two numbers without units and a comma between, such as 0.1,100");
    return Interval{*low, *high};
}

Result<Interval> parse_field(const std::string& text) {
    const auto parts = split_at_comma(text);
    const auto x = parts ? whole_number(parts->first) : std::nullopt;
    const auto y = parts ? whole_number(parts->second) : std::nullopt;
    if (!x || !y) return no("must be two numbers with a comma between, such as 0.5,-0.25");
    return Interval{*x, *y};
}

Result<MotionScale> parse_motion_scale(const std::string& text) {
    const auto parts = split_at_comma(text);
    const auto x = whole_number(parts ? parts->first : text);
    const auto y = parts ? whole_number(parts->second) : x;
    const auto is_scale = [](const std::optional<double>& n) { return n && std::isfinite(*n) && *n != 0; };
    if (!is_scale(x) || !is_scale(y))
        return no("must be a number that is not 0, or two with a comma between");
    return MotionScale{*x, *y};
}

Result<Interval> parse_range_m(const std::string& text) {
    const auto parts = split_at_comma(text);
    if (!parts) return no("must be two distances with a comma between, such as 1.8m,3m");
    const auto near = parse_length_m(parts->first), far = parse_length_m(parts->second);
    if (!near) return near.error();
    if (!far) return far.error();
    if (*near > *far) return no("the nearer distance comes first");
    return Interval{*near, *far};
}

Result<PixelPosition> parse_pixel(const std::string& text) {
    const auto parts = split_at_comma(text);
    constexpr int kMost = 1 << 24;
    const auto x = parse_integer(parts ? parts->first : "", -kMost, kMost, "");
    const auto y = parse_integer(parts ? parts->second : "", -kMost, kMost, "");
    if (!x || !y) return no("must be a pixel, column and row from the top left, such as 480,270");
    return PixelPosition{*x, *y};
}

Result<Rect> parse_region(const std::string& text) {
    constexpr int kMost = 1 << 24;
    std::vector<int> ends;
    std::stringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');)
        if (const auto end = parse_integer(part, -kMost, kMost, "")) ends.push_back(*end);
    const bool fits = std::count(text.begin(), text.end(), ',') == 3 && ends.size() == 4;
    if (!fits || ends[0] >= ends[2] || ends[1] >= ends[3])
        return no(
            "must be the part's first column and row and the ones after its last, such as 480,270,640,360");
    return Rect{ends[0], ends[1], ends[2], ends[3]};
}

Result<WorldPoint> parse_place(const std::string& text) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto others = split_at_comma(text.substr(std::min(comma + 1, text.size())));
    const auto x = whole_number(text.substr(0, comma)), y = whole_number(others ? others->first : ""),
               z = whole_number(others ? others->second : "");
    if (!x || !y || !z || !std::isfinite(*x + *y + *z))
        return no("must be a point of the scene, three numbers in its units, such as 1.5,0,-3");
    return WorldPoint{*x, *y, *z};
}

Result<int> parse_count(const std::string& text) {
    return parse_integer(text, 1, 1 << 24, "a whole number from 1 to 16777216");
}
Result<int> parse_threads(const std::string& text) {
    return parse_integer(text, 0, 1024, "a whole number from 1 to 1024, or 0 for all cores");
}
Result<int> parse_size_px(const std::string& text) {
    return parse_integer(text, 1, 65536, "a whole number of pixels from 1 to 65536");
}
Result<int> parse_index(const std::string& text) {
    return parse_integer(text, 0, 1 << 24, "a whole number of 0 or more");
}
Result<int> parse_blades(const std::string& text) {
    auto blades = parse_integer(text, 0, 64, "3 to 64, or 0 for a round aperture");
    if (blades && *blades > 0 && *blades < 3) return no("must be 3 to 64, or 0 for a round aperture");
    return blades;
}
Result<int> parse_bits(const std::string& text) {
    if (text != "8" && text != "16") return no("must be 8 or 16");
    return text == "8" ? 8 : 16;
}

Result<std::uint64_t> parse_seed(const std::string& text) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    if (failure != std::errc{} || stop != end) return no("must be a whole number of 0 or more");
    return value;
}

Result<std::size_t> parse_bytes(const std::string& text) {
    const auto parts = split(text);
    std::string unit = parts ? parts->rest : "?";
    for (char& c : unit) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (unit.ends_with("ib") && unit.size() == 3) unit.resize(1);
    if (unit.size() == 2 && unit[1] == 'b') unit.resize(1);
    if (unit == "b") unit.clear();
    const std::size_t power = unit.empty() ? 0 : std::string("kmgt").find(unit) + 1;
    if (!parts || power > 4 || unit.size() > 1 || (!unit.empty() && power == 0))
        return no("not an amount of memory; write 512M or 2G, or a plain number of bytes");
    const double bytes = parts->number * std::pow(1024.0, double(power));
    if (!(bytes >= 1) || bytes > 1e18) return no("must be at least 1 byte and at most 900000T");
    return std::size_t(bytes);
}

Result<std::string> parse_text(const std::string& text) {
    if (text.empty()) return no("must not be empty");
    return text;
}

Result<std::vector<std::string>> parse_words(const std::string& text) {
    auto words = split_at(text, ',');
    if (std::count(words.begin(), words.end(), "") > 0) return no("must be names with commas between");
    return words;
}

Result<std::vector<BarrelRim>> parse_barrel(const std::string& text) {
    const auto wrong =
        no("must be rims as RADIUS,DISTANCE in mm, several with ; between, such as \"14,20;14,-20\"");
    std::vector<BarrelRim> rims;
    for (const std::string& rim : split_at(text, ';')) {
        const auto numbers = split_at(rim, ',');
        if (numbers.size() != 2) return wrong;
        const auto radius = parse_length_mm(numbers[0]);
        const bool behind = numbers[1].rfind('-', 0) == 0;
        const std::string length = numbers[1].substr(behind ? 1 : 0);
        // A rim at the pupil itself has no distance, which is not a length.
        const auto zero = parse_number(length);
        const auto distance = zero && *zero == 0 ? Result<double>(0.0) : parse_length_mm(length);
        if (!radius || !distance) return wrong;
        rims.push_back({*radius, behind ? -*distance : *distance});
    }
    return rims;
}

Result<BarnDoors> parse_barn_doors(const std::string& text) {
    const auto wrong =
        no("must be four numbers, left, right, top and bottom, 0 (open) to below 2, such as 0.5,0,0,0.2");
    std::vector<double> doors;
    for (const std::string& part : split_at(text, ',')) {
        const auto door = parse_not_negative(part);
        if (!door || !(*door < 2)) return wrong;
        doors.push_back(*door);
    }
    if (doors.size() != 4) return wrong;
    return BarnDoors{doors[0], doors[1], doors[2], doors[3]};
}

Result<std::vector<std::string>> parse_one_or_two_files(const std::string& text) {
    const auto files = split_at(text, ',');
    if (files.size() > 2 || std::count(files.begin(), files.end(), "") > 0)
        return no("must be one file, or two with a comma between");
    return files;
}

}  // namespace petzval::cli
