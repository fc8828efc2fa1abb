#include "console/changes.h"

#include <algorithm>

namespace petzval::cli {
namespace {

std::string padded(const std::string& text, std::size_t width) {
    return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

}  // namespace

void Changes::add(int frame, std::vector<Value> values) {
    frames_.push_back(frame);
    rows_.push_back(std::move(values));
}

bool Changes::changes(std::size_t column) const {
    return std::any_of(rows_.begin(), rows_.end(),
                       [&](const auto& row) { return row[column].second != rows_.front()[column].second; });
}

std::string Changes::text() const {
    if (rows_.empty()) return "";
    std::string same;
    std::vector<std::string> lines(rows_.size() + 1);
    const auto add_column = [&](const std::string& name, const auto& cell) {
        std::size_t width = name.size();
        for (std::size_t i = 0; i < rows_.size(); ++i) width = std::max(width, std::string(cell(i)).size());
        const std::string gap = lines[0].empty() ? "" : "   ";
        lines[0] += gap + padded(name, width);
        for (std::size_t i = 0; i < rows_.size(); ++i) lines[i + 1] += gap + padded(cell(i), width);
    };
    add_column("frame", [&](std::size_t i) { return std::to_string(frames_[i]); });
    bool any = false;
    for (std::size_t c = 0; c < rows_.front().size(); ++c) {
        const auto& [name, value] = rows_.front()[c];
        if (changes(c))
            add_column(name, [&](std::size_t i) { return rows_[i][c].second; }), any = true;
        else
            same.append("  ").append(name).append(": ").append(value).append("\n");
    }
    std::string text = "the same in all frames\n" + same;
    if (!any) return text + "nothing changes\n";
    text += "what changes\n";
    for (const std::string& line : lines) text += "  " + line + "\n";
    return text;
}

}  // namespace petzval::cli
