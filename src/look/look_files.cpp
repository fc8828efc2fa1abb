// Look files, and the folder of a user's own presets.
#include "petzval/look_json.h"

#include "base/user_folder.h"
#include "base/whole_file.h"
#include "look/preset_list.h"
#include "optics/lens_text.h"

#include <algorithm>
#include <filesystem>

namespace petzval {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t(1) << 20;

Error not_read(const std::string& path, const std::string& why) {
    return {ErrorCode::InvalidFile, path + ": " + why};
}

// True if a lens of that name is a file, seen from a folder, and not a built-in lens.
bool is_lens_file(const std::string& name, const fs::path& folder) {
    std::error_code ignored;
    if (optics::is_lens_text(name)) return false;
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
    if (path.find("lens=") != std::string::npos && !fs::exists(path, missing)) {
        auto linked = look_from_json(path);
        constexpr std::size_t kShown = 60;
        const std::string shown = path.size() > kShown ? path.substr(0, kShown) + "…" : path;
        return linked ? linked : not_read(shown, linked.error().message);
    }
    const auto kind = fs::status(path, missing).type();
    if (kind != fs::file_type::regular && kind != fs::file_type::not_found)
        return not_read(path, "is not a regular file; pipes and devices cannot be read");
    const auto text = text_of_file(path, kMostBytes);
    if (!text) return text.error();
    if (text->size() > kMostBytes) return not_read(path, "is not a look: more than a megabyte");
    auto look = look_from_json(*text);
    if (!look) return not_read(path, look.error().message);
    const fs::path folder = fs::path(path).parent_path();
    change_files(*look, folder, [&](const std::string& file) { return (folder / file).string(); });
    return look;
}

std::string preset_folder() {
    return user_folder("PETZVAL_PRESETS", "XDG_CONFIG_HOME", "/.config", "/petzval/presets");
}

Result<Look> read_preset(const std::string& name) {
    const fs::path folder = preset_folder();
    std::error_code ignored;
    const bool is_name = !name.empty() && name.find_first_of("/\\") == std::string::npos;
    if (is_name && !folder.empty() && fs::is_regular_file(folder / (name + ".json"), ignored))
        return read_look((folder / (name + ".json")).string());
    return look::preset_of(all_presets(), name);
}

std::vector<LookPreset> all_presets() {
    std::vector<LookPreset> all;
    const std::string folder = preset_folder();
    std::error_code ended;
    for (fs::directory_iterator file(folder, ended), end; !ended && file != end; file.increment(ended)) {
        if (file->path().extension() != ".json") continue;
        if (auto look = read_look(file->path().string()))
            all.push_back({file->path().stem().string(), file->path().string(), std::move(*look)});
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    const std::size_t own = all.size();
    for (const LookPreset& preset : look_presets()) {
        const auto same = [&](const LookPreset& other) { return other.name == preset.name; };
        if (std::none_of(all.begin(), all.begin() + std::ptrdiff_t(own), same)) all.push_back(preset);
    }
    return all;
}

std::string look_to_json_in(const Look& look, const std::string& folder) {
    Look seen_from_there = look;
    change_files(seen_from_there, ".", [&](const std::string& file) {
        if (fs::path(file).is_absolute()) return file;
        std::error_code failed;
        const std::string there = fs::relative(fs::absolute(file), folder, failed).string();
        if (failed || there.empty()) return fs::absolute(file).string();
        // A lens by its bare name could be one that ships.
        return there.find('/') == std::string::npos ? "./" + there : there;
    });
    return look_to_json(seen_from_there);
}

}  // namespace petzval
