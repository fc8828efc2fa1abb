#include <cstdio>
#include <petzval/scene.h>

int main() {
    petzval::SceneSettings settings;
    settings.width = 16, settings.height = 9, settings.samples = 1;
    const auto scene = petzval::render_scene(petzval::scene_list().at(0).name, settings);
    if (!scene) return std::puts(scene.error().message.c_str()), 1;
    return scene->colour.width() == 16 && scene->depth_m.height() == 9 ? 0 : 1;
}
