#include "commands.h"

#include <GLFW/glfw3.h>
#include <map>

namespace petzval::view {

const std::vector<Binding>& bindings() {
    static const std::vector<Binding> all{
        {"left", "focus_by -1", "focus nearer"},
        {"right", "focus_by 1", "focus farther"},
        {"up", "stop_by -1", "open the aperture by a third of a stop"},
        {"down", "stop_by 1", "close the aperture by a third of a stop"},
        {"space", "toggle shot.playing", "play or stop the shot"},
        {"period", "frame +1", "next frame"},
        {"comma", "frame -1", "previous frame"},
        {"k", "key_focus", "set a focus key at this frame"},
        {"home", "home", "camera of the scene (drag to turn it)"},
        {"1", "show result", "the result"},
        {"2", "show sharp", "the sharp picture"},
        {"3", "show against", "the second picture"},
        {"4", "show coc", "blur radii: near blue, far orange"},
        {"5", "show depth", "depth: near bright"},
        {"6", "show layers", "surfaces of scatter"},
        {"7", "show levels", "levels of scatter"},
        {"8", "show highlights", "highlights of scatter, spread separately"},
        {"9", "show focus-index", "focus index of gaussian"},
        {"s", "show sprites-2009", "hexadrive: a sprite for each pixel"},
        {"shift+s", "show atlas-2009", "hexadrive: the atlas of the sprites"},
        {"f", "zoom fit", "fit the picture into the window"},
        {"0", "zoom 1", "one to one"},
        {"equal", "zoom in", "zoom in (also the wheel)"},
        {"minus", "zoom out", "zoom out"},
        {"r", "channel r", "red channel only; again: all channels"},
        {"g", "channel g", "green channel"},
        {"b", "channel b", "blue channel"},
        {"a", "channel a", "alpha channel"},
        {"e", "exposure_by 0.5", "brighter by half a stop"},
        {"shift+e", "exposure_by -0.5", "darker by half a stop"},
        {"o", "toggle view.overlay", "colour the near, focused and far zones"},
        {"w", "wipe toggle", "compare: drag the line"},
        {"l", "toggle view.lens", "lens bench: section, discs, curves"},
        {"enter", "toggle view.final", "final quality"},
        {"ctrl+z", "undo", "undo"},
        {"ctrl+shift+z", "redo", "redo"},
        {"ctrl+o", "toggle view.open", "open a file"},
        {"ctrl+c", "copy", "copy the command that makes this frame"},
        {"ctrl+r", "reload", "reload the files"},
        {"tab", "toggle view.panels", "show or hide the panels"},
        {"h", "toggle view.help", "this help"},
        {"shift+slash", "toggle view.help", "this help"},
        {"ctrl+q", "quit", "quit"},
    };
    return all;
}

int key_code(const std::string& name) {
    static const std::map<std::string, int> named{
        {"left", GLFW_KEY_LEFT},     {"right", GLFW_KEY_RIGHT}, {"up", GLFW_KEY_UP},
        {"down", GLFW_KEY_DOWN},     {"enter", GLFW_KEY_ENTER}, {"tab", GLFW_KEY_TAB},
        {"escape", GLFW_KEY_ESCAPE}, {"space", GLFW_KEY_SPACE}, {"equal", GLFW_KEY_EQUAL},
        {"minus", GLFW_KEY_MINUS},   {"slash", GLFW_KEY_SLASH}, {"period", GLFW_KEY_PERIOD},
        {"comma", GLFW_KEY_COMMA},   {"home", GLFW_KEY_HOME},   {"end", GLFW_KEY_END}};
    if (const auto found = named.find(name); found != named.end()) return found->second;
    if (name.size() != 1) return 0;
    if (name[0] >= 'a' && name[0] <= 'z') return GLFW_KEY_A + name[0] - 'a';
    return name[0] >= '0' && name[0] <= '9' ? GLFW_KEY_0 + name[0] - '0' : 0;
}

}  // namespace petzval::view
