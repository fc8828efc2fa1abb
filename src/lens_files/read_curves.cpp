// Lenses drawn as aberration curves, in our JSON.
#include "lens_files/readers.h"

#include <algorithm>
#include <cmath>

namespace petzval::lens_files {
namespace {

using optics::AberrationCurves;

const std::set<std::string> kKnown = {"id",
                                      "name",
                                      "class",
                                      "source",
                                      "year",
                                      "history",
                                      "notes",
                                      "units",
                                      "f_number",
                                      "curves",
                                      "format",
                                      "focal_length_mm",
                                      "shift",
                                      "also",
                                      "about",
                                      "pupil_height",
                                      "sensor_width_mm",
                                      "numbers_only"};

// Dominant wavelengths of the Rec.709 primaries against D65 (from their chromaticities and the CIE 1931
// observer), for the three curves of the talk.
std::optional<double> primary_nm(const std::string& name) {
    if (name == "R") return 611;
    if (name == "G") return 549;
    if (name == "B") return 464;
    return std::nullopt;
}

// A number above `least` and below `most`.
Result<double> number_between(const Json& value, const std::string& what, double least, double most) {
    if (value.is(Json::Type::Number) && value.number > least && value.number < most) return value.number;
    const auto plain = [](double v) {
        std::string text = std::to_string(v);
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.') text.pop_back();
        return text;
    };
    return at_line(value.line,
                   what + " must be a number above " + plain(least) + " and below " + plain(most));
}

struct Curve {
    double wavelength_nm = 0;
    std::vector<double> shift;
    int line = 0;
};

class CurveReader {
public:
    explicit CurveReader(const Json& root) : root_(root) {}

    Result<LensFile> read() {
        file_.format = "petzval JSON, aberration curves";
        if (root_.find("surfaces"))
            return at_line(root_.line, "a lens has either \"surfaces\" or \"curves\", this file has both");
        if (const Status status = use(); !status) return status.error();
        if (const Status status = heights(); !status) return status.error();
        if (const Status status = all_curves(); !status) return status.error();
        for (const JsonMember& member : root_.members)
            if (!kKnown.contains(member.key)) ignored_.add(member.key);
        ignored_.report(file_.warnings);
        file_.curves = std::move(curves_);
        return std::move(file_);
    }

private:
    // Reads the intended use of the curves, and their unit.
    Status use() {
        const struct {
            const char* key;
            double* to;
            double least, most;
            bool needed;
        } numbers[] = {{"focal_length_mm", &curves_.focal_length_mm, 0.01, 1e5, true},
                       {"f_number", &curves_.f_number, 0.1, 1000, true},
                       {"sensor_width_mm", &curves_.sensor_width_mm, 0.01, 1e5, false}};
        for (const auto& [key, to, least, most, needed] : numbers) {
            const Json* value = root_.find(key);
            if (!value && needed)
                return at_line(root_.line, quoted(key) + " is missing: what the curves were drawn for");
            if (!value) continue;
            const auto size = number_between(*value, quoted(key), least, most);
            if (!size) return size.error();
            *to = *size;
        }
        if (const Json* units = root_.find("units")) {
            if (units->string == "mm")
                scale_ = 1 / curves_.focal_length_mm;
            else if (units->string != "focal-length")
                return at_line(units->line, "\"units\" of curves must be \"focal-length\" or \"mm\"");
        }
        return Done{};
    }

    Status heights() {
        const Json* list = root_.find("pupil_height");
        if (!list || !list->is(Json::Type::Array))
            return at_line(list ? list->line : root_.line,
                           "\"pupil_height\" must be a list of heights that rise from 0");
        if (list->items.size() < 2 || list->items.size() > optics::kMostHeights)
            return at_line(list->line, "\"pupil_height\" must hold 2 to 4096 heights");
        for (const Json& item : list->items) {
            const auto height = number_between(item, "a pupil height", -1e-9, 10 / scale_);
            if (!height) return height.error();
            const bool is_first = curves_.pupil_height.empty();
            if (is_first && *height != 0) return at_line(item.line, "the first pupil height must be 0");
            if (!is_first && !(*height * scale_ > curves_.pupil_height.back()))
                return at_line(item.line, "pupil heights must rise");
            curves_.pupil_height.push_back(*height * scale_);
        }
        const double rim = 0.5 / curves_.f_number;
        if (curves_.pupil_height.back() < rim * (1 - 1e-6))
            return at_line(list->items.back().line, "pupil heights must reach the rim of the f-number, " +
                                                        std::to_string(rim / scale_));
        // A rim that was rounded down is the rim.
        curves_.pupil_height.back() = std::max(curves_.pupil_height.back(), rim);
        return Done{};
    }

    Result<Curve> one_curve(const Json& json) const {
        Curve curve;
        curve.line = json.line;
        const Json *wavelength = json.find("wavelength_nm"), *shifts = json.find("shift");
        if (!wavelength || !shifts)
            return at_line(json.line, "a curve needs \"wavelength_nm\" and a list \"shift\"");
        const auto primary = primary_nm(wavelength->string);
        const auto nm =
            primary ? Result<double>(*primary)
                    : number_between(*wavelength, "\"wavelength_nm\" (or \"R\", \"G\", \"B\")", 300, 1100);
        if (!nm) return nm.error();
        curve.wavelength_nm = *nm;
        if (!shifts->is(Json::Type::Array) || shifts->items.size() != curves_.pupil_height.size())
            return at_line(shifts->line, "\"shift\" must be a list of one number per pupil height, " +
                                             std::to_string(curves_.pupil_height.size()));
        const double most = optics::kLargestShift / scale_ * (1 - 1e-12);
        for (const Json& item : shifts->items) {
            const auto shift = number_between(item, "a shift", -most, most);
            if (!shift) return shift.error();
            curve.shift.push_back(*shift * scale_);
        }
        return curve;
    }

    Status all_curves() {
        const Json* list = root_.find("curves");
        if (!list->is(Json::Type::Array) || list->items.empty() || list->items.size() > optics::kMostCurves)
            return at_line(list->line, "\"curves\" must be a list of 1 to 256 curves");
        std::vector<Curve> all;
        for (const Json& item : list->items) {
            auto curve = one_curve(item);
            if (!curve) return curve.error();
            all.push_back(std::move(*curve));
        }
        std::stable_sort(all.begin(), all.end(),
                         [](const Curve& p, const Curve& q) { return p.wavelength_nm < q.wavelength_nm; });
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i > 0 && all[i].wavelength_nm == all[i - 1].wavelength_nm)
                return at_line(all[i].line, "two curves are for the same wavelength");
            curves_.wavelength_nm.push_back(all[i].wavelength_nm);
            curves_.shift.push_back(std::move(all[i].shift));
        }
        if (all.size() < 3)
            file_.warnings.emplace_back(
                "fewer than three wavelengths: colour is a straight line between them, or none");
        return Done{};
    }

    const Json& root_;
    LensFile file_;
    AberrationCurves curves_;
    double scale_ = 1;  // focal lengths per unit of the file
    Ignored ignored_;
};

}  // namespace

Result<LensFile> read_json_curves(const Json& root) { return CurveReader(root).read(); }

}  // namespace petzval::lens_files
