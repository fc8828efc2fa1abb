#include "petzval/look_file.h"

#include "files/output_file.h"

#include <filesystem>

namespace petzval {

Status write_look(const Look& look, const std::string& path, bool overwrite) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const std::string text = look_to_json_in(look, folder.empty() ? "." : folder.string());
    auto file = OutputFile::create(path, overwrite);
    if (!file) return file.error();
    (*file)->write_at(0, text.data(), text.size());
    return (*file)->commit();
}

}  // namespace petzval
