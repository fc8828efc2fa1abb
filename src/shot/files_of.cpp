#include "petzval/shot.h"

#include <filesystem>

namespace petzval {

std::vector<std::string> files_of(const ShotSource& source) {
    std::vector<std::string> files{source.path};
    for (const std::string* other : {&source.read.depth_file, &source.behind, &source.holdout})
        if (!other->empty()) files.push_back(*other);
    files.insert(files.end(), source.merge.begin(), source.merge.end());
    if (!source.mask.empty()) files.push_back(file_channel(source.mask).file);
    if (!source.lights.empty()) files.push_back(source.lights);
    return files;
}

std::vector<std::string> files_of(const Look& look) {
    std::vector<std::string> files;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(look.lens.name, ignored)) files.push_back(look.lens.name);
    for (const std::string& file : {look.kernel_image_far, look.kernel_image_near, look.aperture_image})
        if (!file.empty()) files.push_back(file);
    return files;
}

}  // namespace petzval
