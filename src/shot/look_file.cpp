#include "petzval/look_file.h"

#include "petzval/look_json.h"

#include "files/output_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace petzval {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t(1) << 20;

Error not_read(const std::string& path, const std::string& why) {
    return {ErrorCode::InvalidFile, path + ": " + why};
}

fs::path folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

// True if a lens of that name is a file, seen from a folder, and not a built-in lens.
bool is_lens_file(const std::string& name, const fs::path& folder) {
    std::error_code ignored;
    return name.find('/') != std::string::npos ||
           (fs::path(name).has_extension() && fs::is_regular_file(folder / name, ignored));
}

// Every file that the look names; `change` gives its new name. The lens is seen from `folder` before.
template <typename Change>
void change_files(Look& look, const fs::path& folder, const Change& change) {
    if (is_lens_file(look.lens.name, folder)) look.lens.name = change(look.lens.name);
    for (std::string* file : {&look.aperture_image, &look.kernel_image_far, &look.kernel_image_near})
        if (!file->empty()) *file = change(*file);
}

}  // namespace

Result<Look> read_look(const std::string& path) {
    std::error_code missing;
    const auto kind = fs::status(path, missing).type();
    if (kind != fs::file_type::regular && kind != fs::file_type::not_found)
        return not_read(path, "is not a regular file; pipes and devices cannot be read");
    std::ifstream in(path, std::ios::binary);
    if (!in) return not_read(path, "cannot be read");
    if (const auto bytes = fs::file_size(path, missing); !missing && bytes > kMostBytes)
        return not_read(path, "is no look: more than a megabyte");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) return not_read(path, "cannot be read to its end");
    auto look = look_from_json(text);
    if (!look) return not_read(path, look.error().message);
    const fs::path folder = fs::path(path).parent_path();
    change_files(*look, folder, [&](const std::string& file) { return (folder / file).string(); });
    return look;
}

Status write_look(const Look& look, const std::string& path, bool overwrite) {
    Look seen_from_there = look;
    change_files(seen_from_there, ".", [&](const std::string& file) {
        if (fs::path(file).is_absolute()) return file;
        std::error_code failed;
        const std::string there = fs::relative(fs::absolute(file), folder_of(path), failed).string();
        if (failed || there.empty()) return fs::absolute(file).string();
        // A lens by its bare name could be one that ships.
        return there.find('/') == std::string::npos ? "./" + there : there;
    });
    const std::string text = look_to_json(seen_from_there);
    auto file = OutputFile::create(path, overwrite);
    if (!file) return file.error();
    (*file)->write_at(0, text.data(), text.size());
    return (*file)->commit();
}

}  // namespace petzval
