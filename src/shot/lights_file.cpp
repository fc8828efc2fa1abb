#include "petzval/names.h"
#include "petzval/shot.h"

#include "base/whole_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace petzval {
namespace {

constexpr const char* kAccepted = "x, y, depth or coc, r, g, b, and size, spectrum, vx, vy if wanted";

constexpr std::size_t kLongestLine = 4096;

enum Column { kX, kY, kDepth, kCoc, kR, kG, kB, kSize, kSpectrum, kVx, kVy, kColumns };
constexpr std::array<const char*, kColumns> kNames{"x", "y",    "depth",    "coc", "r", "g",
                                                   "b", "size", "spectrum", "vx",  "vy"};

std::string_view trimmed(std::string_view text) {
    constexpr const char* kSpace = " \t\r";
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string quoted(std::string_view text) {
    std::string shown(text.substr(0, 40));
    for (char& c : shown)
        if (c < 32 || c == 127) c = '?';
    return "'" + shown + (text.size() > 40 ? "…'" : "'");
}

// Calls take(index, field) for each field of a line; take returns false to stop.
template <typename Take>
std::size_t for_each_field(std::string_view line, const Take& take) {
    for (std::size_t n = 0;; ++n) {
        const std::size_t comma = line.find(',');
        if (!take(n, trimmed(line.substr(0, comma)))) return n;
        if (comma == std::string_view::npos) return n + 1;
        line.remove_prefix(comma + 1);
    }
}

class Reader {
public:
    Reader(std::string path, const Rect& data_window) : path_(std::move(path)), data_window_(data_window) {}

    Result<Lights> read() {
        std::error_code missing;
        const auto kind = std::filesystem::status(path_, missing).type();
        if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
            return Error{ErrorCode::InvalidFile,
                         path_ + ": is not a regular file; pipes and devices cannot be read"};
        std::ifstream in(path_, std::ios::binary);
        if (!in) return unreadable(path_, errno);
        std::vector<char> text(kLongestLine + 1);
        bool has_header = false;
        while (in.getline(text.data(), std::streamsize(text.size()))) {
            ++line_;
            std::string_view line(text.data(), std::size_t(in.gcount()) - (in.eof() ? 0 : 1));
            if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // byte order mark
            line = trimmed(line.substr(0, line.find('#')));
            if (line.empty()) continue;
            const std::optional<std::string> wrong = has_header ? take_point(line) : take_header(line);
            if (wrong)
                return Error{ErrorCode::InvalidFile, path_ + ":" + std::to_string(line_) + ": " + *wrong};
            has_header = true;
        }
        if (!in.bad() && !in.eof())
            return Error{ErrorCode::InvalidFile, path_ + ":" + std::to_string(line_ + 1) + ": more than " +
                                                     std::to_string(kLongestLine) + " characters in a line"};
        if (in.bad()) return Error{ErrorCode::ReadFailed, path_ + ": cannot be read to its end"};
        if (!has_header)
            return Error{ErrorCode::InvalidFile,
                         path_ + ": is empty; its first line names the columns: " + std::string(kAccepted)};
        return std::move(result_);
    }

private:
    std::optional<std::string> take_header(std::string_view line) {
        std::optional<std::string> wrong;
        std::array<bool, kColumns> seen{};
        for_each_field(line, [&](std::size_t, std::string_view field) {
            std::string name(field);
            std::transform(name.begin(), name.end(), name.begin(),
                           [](unsigned char c) { return char(c >= 'A' && c <= 'Z' ? c + 32 : c); });
            const auto* const known = std::find(kNames.begin(), kNames.end(), name);
            const auto column = std::size_t(known - kNames.begin());
            if (known == kNames.end())
                wrong = quoted(field) + " is not a column; the first line names them: " + kAccepted;
            else if (seen[column])
                wrong = "column " + name + " occurs twice";
            if (wrong) return false;
            seen[column] = true;
            order_.push_back(Column(column));
            return true;
        });
        if (wrong) return wrong;
        for (const Column needed : {kX, kY, kR, kG, kB})
            if (!seen[needed])
                return "column " + std::string(kNames[needed]) + " is missing; needed are " + kAccepted;
        if (seen[kDepth] == seen[kCoc])
            return std::string(seen[kCoc] ? "columns depth and coc are both given; give one"
                                          : "column depth or coc is missing");
        result_.has_depth = seen[kDepth];
        return std::nullopt;
    }

    // Left empty: that of the picture's light.
    static std::optional<std::string> take_spectrum(std::string_view field, LightPoint& p) {
        if (field.empty()) return std::nullopt;
        const auto spectrum = parse<LightSpectrum>(std::string(field));
        if (!spectrum) return quoted(field) + " in column spectrum is " + spectrum.error().message;
        p.spectrum = *spectrum;
        return std::nullopt;
    }

    std::optional<std::string> take_point(std::string_view line) {
        std::optional<std::string> wrong;
        std::array<float, kColumns> values{};
        LightPoint p;
        const std::size_t fields = for_each_field(line, [&](std::size_t i, std::string_view field) {
            if (i >= order_.size()) {
                wrong = "more values than the " + std::to_string(order_.size()) + " columns";
                return false;
            }
            if (order_[i] == kSpectrum) {
                wrong = take_spectrum(field, p);
                return !wrong;
            }
            if (field.starts_with('+')) field.remove_prefix(1);
            double value = 0;
            const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), value);
            if (failure != std::errc{} || end != field.data() + field.size())
                wrong = quoted(field) + " in column " + kNames[order_[i]] + " is not a number";
            constexpr double kLargest = std::numeric_limits<float>::max();
            values[order_[i]] =
                std::abs(value) > kLargest ? std::numeric_limits<float>::infinity() : float(value);
            return !wrong;
        });
        if (wrong) return wrong;
        if (fields < order_.size())
            return std::to_string(fields) + " values, but there are " + std::to_string(order_.size()) +
                   " columns";
        p.x = values[kX] - float(data_window_.x0), p.y = values[kY] - float(data_window_.y0);
        p.r = values[kR], p.g = values[kG], p.b = values[kB];
        p.diameter_px = values[kSize];
        if (result_.has_depth) p.depth_m = values[kDepth];
        p.coc_px = result_.has_depth ? p.depth_m : values[kCoc];  // a depth that is NaN is not a radius of 0
        result_.points.push_back(p);
        return std::nullopt;
    }

    std::string path_;
    Rect data_window_;
    std::size_t line_ = 0;
    std::vector<Column> order_;
    Lights result_;
};

}  // namespace

Result<Lights> read_lights(const std::string& path, const Rect& data_window) {
    return Reader(path, data_window).read();
}

std::string lights_text(const std::vector<LightPoint>& points, const std::vector<std::string>& comment) {
    std::string text;
    text.reserve(points.size() * 72 + 256);
    for (const std::string& line : comment) text += "# " + line + "\n";
    const bool has_spectra =
        std::any_of(points.begin(), points.end(), [](const LightPoint& p) { return p.spectrum.has_value(); });
    text += has_spectra ? "x,y,depth,r,g,b,size,spectrum\n" : "x,y,depth,r,g,b,size\n";
    for (const LightPoint& p : points) {
        char separator = '\0';
        for (const float value : {p.x, p.y, p.depth_m, p.r, p.g, p.b, p.diameter_px}) {
            std::array<char, 32> digits;
            if (separator) text += separator;
            text.append(digits.data(),
                        std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
            separator = ',';
        }
        if (has_spectra) text += std::string(",") + (p.spectrum ? name_of(*p.spectrum) : "");
        text += '\n';
    }
    return text;
}

}  // namespace petzval
