// Parsers of flag values: numbers, lengths with units, pairs, sizes, names. Each returns the value, or a
// message that completes the sentence "--flag TEXT: …" with the accepted values.
#pragma once

#include "petzval/lens_choice.h"
#include "petzval/names.h"
#include "petzval/reports/words.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace petzval::cli {

struct Interval {
    double low = 0, high = 0;
};

// A number, "inf" included; never NaN.
Result<double> parse_number(const std::string& text);
// The same, and more than 0.
Result<double> parse_positive(const std::string& text);
Result<double> parse_not_negative(const std::string& text);
// 0…1.
Result<double> parse_share(const std::string& text);
// "2.8" or "f/2.8".
Result<double> parse_f_number(const std::string& text);

// "85mm", "8.5cm", "0.085m"; a bare number has the unit of the function's name. Positive, "inf" included.
Result<double> parse_length_mm(const std::string& text);
Result<double> parse_length_m(const std::string& text);

// "0.1,100": two numbers, in either order.
// "2" for both, or "2,-2": neither is 0.
struct MotionScale {
    double x = 1, y = 1;
};
Result<MotionScale> parse_motion_scale(const std::string& text);
Result<Interval> parse_range(const std::string& text);
// "0.5,-0.25": a place in the picture, as two numbers.
Result<Interval> parse_field(const std::string& text);
// "1.5m,3m": two lengths, the nearer first.
Result<Interval> parse_range_m(const std::string& text);
// "480,270".
Result<PixelPosition> parse_pixel(const std::string& text);
// "480,270,640,360": two corners, the second beyond the first.
Result<Rect> parse_region(const std::string& text);
// "1.5,0,-3": three finite numbers.
Result<WorldPoint> parse_place(const std::string& text);

Result<int> parse_count(const std::string& text);    // 1 and more
Result<int> parse_threads(const std::string& text);  // 0 (all) … 1024
Result<int> parse_size_px(const std::string& text);  // 1 … 65536
Result<int> parse_index(const std::string& text);    // 0 and more
Result<int> parse_blades(const std::string& text);   // 0 (round) or 3 … 64
Result<int> parse_bits(const std::string& text);     // 8 or 16
Result<std::uint64_t> parse_seed(const std::string& text);
// "2G", "512MiB", "1.5g" (powers of 1024), or plain bytes.
Result<std::size_t> parse_bytes(const std::string& text);

Result<std::string> parse_text(const std::string& text);  // anything but nothing

Result<std::vector<std::string>> parse_words(const std::string& text);  // "a,b": none of them empty

// Names of values, in reading order.
template <typename T>
using NameTable = std::vector<std::pair<std::string, T>>;

// Names of a public enum.
template <typename E>
NameTable<E> name_table() {
    NameTable<E> table;
    for (const Named<E>& known : names<E>()) table.emplace_back(known.name, known.value);
    return table;
}

// "off|on"
template <typename T>
std::string placeholder_of(const NameTable<T>& table) {
    std::string all;
    for (const auto& [name, value] : table) all += (all.empty() ? "" : "|") + name;
    return all;
}

// One of the names of a table.
template <typename T>
Result<T> parse_name(const std::string& text, const NameTable<T>& table) {
    std::string names;
    for (const auto& [name, value] : table) {
        if (name == text) return value;
        names += (names.empty() ? "" : ", ") + name;
    }
    return Error{ErrorCode::InvalidArgument, "not one of " + names};
}

// "14mm,20mm;14mm,-20mm": rims of a barrel, radius and distance.
Result<std::vector<BarrelRim>> parse_barrel(const std::string& text);
// "0.5,0,0,0.2".
Result<BarnDoors> parse_barn_doors(const std::string& text);
// "far.exr" or "far.exr,near.exr".
Result<std::vector<std::string>> parse_one_or_two_files(const std::string& text);

}  // namespace petzval::cli
