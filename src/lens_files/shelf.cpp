#include "lens_files/shelf.h"

#include "lens_files/json.h"

#include <filesystem>

namespace petzval::lens_files {
namespace {

bool is_also_called(const ShelfItem& item, const std::string& id) {
    const auto json = parse_json(item.text);
    const Json* also = json ? json->find("also") : nullptr;
    return also && also->string == id;
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
