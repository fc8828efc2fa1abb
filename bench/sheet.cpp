// petzval_bench_sheet OUT.png LIST: squares of 48 pixels of several pictures side by side, three times as
// large, two rows' worth to a line of the sheet. LIST has one line for each: X Y EXPOSURE FILE.exr FILE.exr …
#include "petzval/develop.h"
#include "petzval/files.h"

#include "process.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace petzval;
using bench::fail;

constexpr int kSquare = 48, kScale = 3, kGap = 4, kPanel = kScale * kSquare + kGap, kColumns = 2;

struct Row {
    int x = 0, y = 0;
    float exposure = 1;
    std::vector<std::string> files;
};

std::vector<Row> rows_of(const char* path) {
    std::ifstream file(path);
    if (!file) fail(std::string(path) + ": cannot be read");
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        Row row;
        if (!(words >> row.x >> row.y >> row.exposure)) continue;
        for (std::string name; words >> name;) row.files.push_back(name);
        rows.push_back(std::move(row));
    }
    return rows;
}

void draw(Picture& sheet, const std::string& path, const Row& row, int x0, int y0) {
    ReadOptions options;
    options.need_depth = false;
    const auto frame = read_frame(path, options);
    if (!frame) fail(frame.error().message);
    const Picture& picture = frame->colour;
    for (int y = 0; y < kScale * kSquare; ++y)
        for (int x = 0; x < kScale * kSquare; ++x) {
            const int u = std::clamp(row.x + x / kScale, 0, picture.width() - 1);
            const int v = std::clamp(row.y + y / kScale, 0, picture.height() - 1);
            sheet(x0 + x, y0 + y) = row.exposure * picture(u, v);
        }
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) fail("OUT.png LIST");
    const std::vector<Row> rows = rows_of(words[2]);
    if (rows.empty()) fail(std::string(words[2]) + ": no squares");
    std::size_t panels = 0;
    for (const Row& row : rows) panels = std::max(panels, row.files.size());
    const int block = int(panels) * kPanel + 3 * kGap, lines = (int(rows.size()) + kColumns - 1) / kColumns;
    Picture sheet(kColumns * block, lines * kPanel);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t panel = 0; panel < rows[i].files.size(); ++panel)
            draw(sheet, rows[i].files[panel], rows[i], int(i) % kColumns * block + int(panel) * kPanel,
                 int(i) / kColumns * kPanel);
    DevelopSettings settings;
    settings.tone = ToneCurve::None, settings.dither = false;
    const PngPixels png{sheet.width(), sheet.height(), 3, 8, develop(sheet, settings)};
    if (const Status status = write_png(words[1], png); !status) fail(status.error().message);
    return 0;
}
