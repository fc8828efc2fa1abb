#include "optics/glass.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

namespace petzval::optics {

double Glass::index(double wavelength_um) const {
    const double w2 = wavelength_um * wavelength_um;
    double n2 = 0;
    switch (formula) {
        case Dispersion::Constant:
            return constant;
        case Dispersion::Abbe:
            return terms[0][0] + terms[0][1] / w2;
        case Dispersion::Sellmeier:
            n2 = constant;
            for (const auto& [b, c] : terms) n2 += b * w2 / (w2 - c);
            break;
        case Dispersion::PowerSeries:
            for (const auto& [a, p] : terms) n2 += a * std::pow(wavelength_um, p);
            break;
    }
    return std::sqrt(n2);
}

double Glass::internal_transmittance(double wavelength_nm, double path_mm) const {
    if (transmittance.empty()) return 1;
    const auto above = std::find_if(transmittance.begin(), transmittance.end(),
                                    [&](const auto& s) { return s.wavelength_nm >= wavelength_nm; });
    double share = 0;
    if (above == transmittance.end()) {
        share = transmittance.back().share;
    } else if (above == transmittance.begin()) {
        share = above->share;
    } else {
        const auto& low = *(above - 1);
        const double t = (wavelength_nm - low.wavelength_nm) / (above->wavelength_nm - low.wavelength_nm);
        share = low.share + t * (above->share - low.share);
    }
    return std::pow(share, path_mm / 10);
}

double Glass::abbe_number() const {
    const double spread = index(kLineF_um) - index(kLineC_um);
    return spread == 0 ? std::numeric_limits<double>::infinity() : (index(kLineD_um) - 1) / spread;
}

Glass constant_glass(std::string name, double index) {
    Glass glass;
    glass.name = std::move(name);
    glass.constant = index;
    return glass;
}

Glass abbe_glass(std::string name, double nd, double vd) {
    const double per_line_pair = 1 / (kLineF_um * kLineF_um) - 1 / (kLineC_um * kLineC_um);
    const double b = (nd - 1) / (vd * per_line_pair);
    Glass glass;
    glass.name = std::move(name);
    glass.formula = Dispersion::Abbe;
    glass.terms = {{nd - b / (kLineD_um * kLineD_um), b}};
    return glass;
}

std::string normalised_glass_name(const std::string& name) {
    std::string result;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            result += char(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

void GlassCatalogue::add(Glass glass) { glasses_.push_back(std::move(glass)); }

const Glass* GlassCatalogue::find(const std::string& name) const {
    const std::string wanted = normalised_glass_name(name);
    const Glass* found = nullptr;
    for (const Glass& glass : glasses_)
        if (normalised_glass_name(glass.name) == wanted) found = &glass;
    return found;
}

namespace {

// Levenshtein distance: the fewest single-letter changes that turn one name into the other.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
        }
    }
    return row[b.size()];
}

}  // namespace

std::vector<std::string> GlassCatalogue::similar_names(const std::string& name) const {
    const std::string wanted = normalised_glass_name(name.substr(0, 40));
    std::vector<std::pair<std::size_t, std::string>> candidates;
    for (const Glass& glass : glasses_) {
        const std::string known = normalised_glass_name(glass.name);
        // Old and new makes of a glass differ by the N of "no lead": SK5 and N-SK5.
        const bool same_but_n = "N" + wanted == known || "N" + known == wanted;
        const std::size_t distance = same_but_n ? 0 : edit_distance(wanted, known);
        if (distance <= 2) candidates.emplace_back(distance, glass.name);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (const auto& [distance, known] : candidates)
        if (names.size() < 3) names.push_back(known);
    return names;
}

}  // namespace petzval::optics
