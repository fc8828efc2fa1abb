#include <cstdio>
#include <petzval/shots/scene_files.h>
#include <string>

int main(int, char** argv) {
    petzval::SceneFiles files{.scene = petzval::scene_list().at(0).name};
    files.settings.width = 16, files.settings.height = 9, files.settings.samples = 1;
    files.output = std::string(argv[1]) + "/scene.exr";
    const auto made = petzval::make_scene_files(files);
    if (!made) return std::puts(made.error().message.c_str()), 1;
    const auto read = petzval::read_frame(files.output);
    return read && read->colour.width() == 16 && read->depth.height() == 9 ? 0 : 1;
}
