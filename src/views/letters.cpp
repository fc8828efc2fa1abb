// The letters of legends: 5 x 7 pixels, drawn by hand for petzval.
#include "petzval/views.h"

#include <array>
#include <cctype>
#include <string_view>

namespace petzval {
namespace {

constexpr int kColumns = 5, kRows = 7, kAdvance = 6;

// A line of the alphabet: its letters, and their rows beside each other, one blank column between.
struct Strip {
    std::string_view letters;
    std::array<std::string_view, kRows> rows;
};

// clang-format off
constexpr std::array<Strip, 3> kStrips{{
    {"ABCDEFGHIJKLMNOP", {
        " ###  ####   ###  ####  ##### #####  ###  #   #  ###    ### #   # #     #   # #   #  ###  #### ",
        "#   # #   # #   # #   # #     #     #   # #   #   #      #  #  #  #     ## ## ##  # #   # #   #",
        "#   # #   # #     #   # #     #     #     #   #   #      #  # #   #     # # # ##  # #   # #   #",
        "##### ####  #     #   # ####  ####  # ### #####   #      #  ##    #     # # # # # # #   # #### ",
        "#   # #   # #     #   # #     #     #   # #   #   #      #  # #   #     #   # #  ## #   # #    ",
        "#   # #   # #   # #   # #     #     #   # #   #   #   #  #  #  #  #     #   # #  ## #   # #    ",
        "#   # ####   ###  ####  ##### #      #### #   #  ###   ##   #   # ##### #   # #   #  ###  #    ",
    }},
    {"QRSTUVWXYZ012345", {
        " ###  ####   #### ##### #   # #   # #   # #   # #   # #####  ###    #    ###  #####    #  #####",
        "#   # #   # #       #   #   # #   # #   # #   # #   #     # #   #  ##   #   #    #    ##  #    ",
        "#   # #   # #       #   #   # #   # #   #  # #   # #     #  #  ##   #       #   #    # #  #### ",
        "#   # ####   ###    #   #   # #   # # # #   #     #     #   # # #   #      #     #  #  #      #",
        "# # # # #       #   #   #   # #   # # # #  # #    #    #    ##  #   #     #       # #####     #",
        "#  #  #  #      #   #   #   #  # #  ## ## #   #   #   #     #   #   #    #    #   #    #  #   #",
        " ## # #   # ####    #    ###    #   #   # #   #   #   #####  ###   ###  #####  ###     #   ### ",
    }},
    {"6789.,-+/:<>()", {
        "  ##  #####  ###   ###                              #          #   #       #   #   ",
        " #        # #   # #   #                     #       #   #     #     #     #     #  ",
        "#        #  #   # #   #                     #      #         #       #   #       # ",
        "####    #    ###   ####             ####  #####   #         #         #  #       # ",
        "#   #  #    #   #     #                     #    #           #       #   #       # ",
        "#   #  #    #   #    #          #           #   #       #     #     #     #     #  ",
        " ###   #     ###   ##     #    #                #              #   #       #   #   ",
    }},
}};
// clang-format on

// Lower case is drawn as upper case; characters without a glyph are blank.
bool is_ink(char letter, int column, int row) {
    const char upper = char(std::toupper(static_cast<unsigned char>(letter)));
    for (const Strip& strip : kStrips) {
        const std::size_t at = strip.letters.find(upper);
        if (at != std::string_view::npos)
            return strip.rows[std::size_t(row)][at * kAdvance + std::size_t(column)] == '#';
    }
    return false;
}

}  // namespace

int text_width_px(const std::string& text, int scale) { return int(text.size()) * kAdvance * scale; }
int text_height_px(int scale) { return kRows * scale; }

void draw_text(View<Rgba> picture, int x0, int y0, const std::string& text, int scale, Rgba colour) {
    for (std::size_t i = 0; i < text.size(); ++i)
        for (int y = 0; y < kRows * scale; ++y)
            for (int x = 0; x < kColumns * scale; ++x) {
                const int px = x0 + int(i) * kAdvance * scale + x, py = y0 + y;
                if (picture.rect().contains(px, py) && is_ink(text[i], x / scale, y / scale))
                    picture(px, py) = colour;
            }
}

}  // namespace petzval
