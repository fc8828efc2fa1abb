#include "lens_files/shelf.h"

#include "lens_files/json.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace petzval::lens_files {
namespace {

// Letters and digits alone, in lower case: "Helios 44-2" and "helios-44-2" are one name.
std::string plain(std::string_view name) {
    std::string letters;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            letters += char(std::tolower(static_cast<unsigned char>(c)));
    return letters;
}

bool is_also_called(const ShelfItem& item, const std::string& given) {
    const auto json = parse_json(item.text);
    if (!json) return false;
    const std::string wanted = plain(given);
    if (wanted.empty()) return false;
    const Json* also = json->find("also");
    if ((also && also->string == given) || plain(item.name) == wanted) return true;
    const Json* names = json->find("names");
    return names && std::any_of(names->items.begin(), names->items.end(),
                                [&](const Json& name) { return plain(name.string) == wanted; });
}

}  // namespace

Result<LensFile> find_lens(const std::string& name_or_path) {
    for (const ShelfItem& item : shelf())
        if (item.name == name_or_path) return read_lens(item.text, name_or_path);
    std::error_code problem;
    if (std::filesystem::exists(name_or_path, problem)) return load_lens_file(name_or_path);
    for (const ShelfItem& item : shelf())
        if (is_also_called(item, name_or_path)) return read_lens(item.text, std::string(item.name));
    std::string known;
    for (const ShelfItem& item : shelf()) known.append(" ").append(item.name);
    return Error{ErrorCode::InvalidArgument, "there is no lens or lens file \"" + name_or_path +
                                                 "\"; lenses with a prescription:" + known};
}

}  // namespace petzval::lens_files
