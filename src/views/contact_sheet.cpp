#include "petzval/views.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace petzval {

Picture resized(const Picture& from, int width, int height) {
    Picture to(width, height);
    const auto begin = [](int i, int small, int large) { return int(std::int64_t(i) * large / small); };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int x0 = begin(x, width, from.width()), y0 = begin(y, height, from.height());
            const int x1 = std::max(x0 + 1, begin(x + 1, width, from.width()));
            const int y1 = std::max(y0 + 1, begin(y + 1, height, from.height()));
            Rgba sum;
            for (int v = y0; v < y1; ++v)
                for (int u = x0; u < x1; ++u) sum += from(u, v);
            to(x, y) = (1.0f / float((x1 - x0) * (y1 - y0))) * sum;
        }
    return to;
}

void draw_caption(View<Rgba> picture, const std::string& text) {
    int scale = std::clamp(picture.width() / 240, 1, 4);
    while (scale > 1 && text_width_px(text, scale) + 8 * scale > picture.width()) --scale;
    draw_text(picture, 4 * scale + 1, 4 * scale + 1, text, scale, {0, 0, 0, 1});
    draw_text(picture, 4 * scale, 4 * scale, text, scale, {0.9f, 0.9f, 0.9f, 1});
}

Picture contact_sheet(const std::vector<Picture>& cells, int columns) {
    constexpr int kGap = 2;
    const int count = int(cells.size()), width = cells[0].width(), height = cells[0].height();
    const int square = int(std::ceil(std::sqrt(double(count) * height / width)));
    columns = std::min(count, columns > 0 ? columns : std::max(1, square));
    const int rows = (count + columns - 1) / columns;
    Picture sheet(columns * (width + kGap) - kGap, rows * (height + kGap) - kGap, {0, 0, 0, 1});
    for (int i = 0; i < count; ++i)
        for (int y = 0; y < height; ++y)
            std::copy_n(
                cells[std::size_t(i)].row(y), width,
                sheet.row(i / columns * (height + kGap) + y) + std::ptrdiff_t(i % columns) * (width + kGap));
    return sheet;
}

}  // namespace petzval
