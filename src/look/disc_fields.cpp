// Fields that a look chose, and those that show only away from the middle of the picture.
#include "petzval/look_check.h"

#include "look/fields.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace petzval {

std::vector<std::string> chosen_fields(const Look& look) {
    static const Look defaults;
    std::vector<std::string> paths;
    for (const look::Field& field : look::fields())
        if (field.get(look) != field.get(defaults)) paths.push_back(field.path);
    return paths;
}

bool is_off_axis(const std::string& field) {
    static constexpr std::array<std::string_view, 7> kFields{"lens.cats_eye",
                                                             "lens.lateral_colour",
                                                             "lens.added_lateral_colour_percent",
                                                             "lens.added_field_curvature_mm",
                                                             "lens.coma",
                                                             "lens.astigmatism",
                                                             "lens.distortion"};
    return std::find(kFields.begin(), kFields.end(), field) != kFields.end();
}

}  // namespace petzval
