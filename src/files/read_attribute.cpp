#include "petzval/files.h"

#include "files/exr/file.h"
#include "files/exr/prescan.h"
#include "files/raster/raster.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace petzval {
namespace {

Result<std::string> exr_text(const std::shared_ptr<const InputFile>& file, const std::string& name) {
    const std::shared_ptr<Workers> alone = own_workers(1);
    const Result<ExrFile> exr = ExrFile::open(file, ReadOptions{}.max_pixels, *alone);
    if (!exr) return exr.error();
    for (int part = 0; part < exr->parts->parts(); ++part)
        if (const auto* text = exr->parts->header(part).findTypedAttribute<Imf::StringAttribute>(name))
            return text->value();
    return std::string();
}

}  // namespace

Result<std::string> read_text_attribute(const std::string& path, const std::string& name) {
    const auto file = InputFile::open(path);
    if (!file) return file.error();
    Result<std::string> text = std::string();
    const Status sound = guarded(**file, [&]() -> Status {
        text = starts_like_exr(**file) ? exr_text(*file, name) : text_of_png(**file, name);
        return text ? Status(Done{}) : text.error();
    });
    return sound ? std::move(text) : Result<std::string>(sound.error());
}

}  // namespace petzval
