#include "base/nearest_word.h"

#include <algorithm>
#include <numeric>

namespace petzval {
namespace {

// Number of single-letter edits from a to b (Levenshtein, 1966).
std::size_t edits(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::string nearest_word(const std::string& given, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = 3;
    for (const std::string& name : known) {
        const bool begins = given.size() > 4 && name.starts_with(given);
        const std::size_t distance = begins ? 0 : edits(given, name);
        const bool nearer = distance < least || (begins && least == 0 && name.size() < best.size());
        if (nearer && distance * 3 <= given.size()) best = name, least = distance;
    }
    return best;
}

}  // namespace petzval
