// The window itself: GLFW and ImGui, its events, its frames.
#include "app.h"
#include "canvas.h"
#include "commands.h"
#include "lens_panel.h"
#include "panels.h"
#include "prepare.h"
#include "script.h"
#include "texture.h"
#include "view.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <imgui.h>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace petzval::view {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kFrame = std::chrono::microseconds(16'000);

std::string glfw_says() {
    const char* why = nullptr;
    glfwGetError(&why);
    return why ? std::string(": ") + why : "";
}

struct KeyPress {
    int code = 0;
    bool shift = false, ctrl = false, repeated = false;
};

// Keys pressed since the last tick: ImGui looks at held keys and would miss one that was released at once.
// GLFW calls back on the window's thread.
std::vector<KeyPress>& pressed_keys() {
    static std::vector<KeyPress> keys;
    return keys;
}

void on_key(GLFWwindow*, int code, int, int action, int mods) {
    if (action == GLFW_RELEASE) return;
    pressed_keys().push_back(
        {code, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, action == GLFW_REPEAT});
}

// True if the painted pixels were lost, for example below another window.
bool& is_exposed() {
    static bool exposed = false;
    return exposed;
}
void on_expose(GLFWwindow*) { is_exposed() = true; }

// A file that was dropped on the window; empty: none.
std::string& dropped_file() {
    static std::string path;
    return path;
}
void on_drop(GLFWwindow*, int count, const char** paths) {
    if (count > 0) dropped_file() = paths[0];
}

// Hash of everything to be painted: equal hashes look alike.
std::uint64_t fingerprint(const ImDrawData& drawn) {
    std::uint64_t print = Texture::loads();
    const auto add = [&](const void* from, std::size_t bytes) {
        const auto* at = static_cast<const unsigned char*>(from);
        for (std::uint64_t word = 0; bytes > 0; at += sizeof word, word = 0) {
            const std::size_t some = std::min(bytes, sizeof word);
            std::memcpy(&word, at, some);
            print = (print ^ word) * 0x9e3779b97f4a7c15U;
            print ^= print >> 29;
            bytes -= some;
        }
    };
    add(&drawn.DisplaySize, sizeof drawn.DisplaySize);
    add(&drawn.FramebufferScale, sizeof drawn.FramebufferScale);
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
        const ImDrawList& list = *drawn.CmdLists[i];
        add(list.VtxBuffer.Data, std::size_t(list.VtxBuffer.size_in_bytes()));
        add(list.IdxBuffer.Data, std::size_t(list.IdxBuffer.size_in_bytes()));
        for (const ImDrawCmd& command : list.CmdBuffer) {
            add(&command.ClipRect, sizeof command.ClipRect);
            add(&command.TextureId, sizeof command.TextureId);
        }
    }
    return print;
}

KeyPress key_press(const std::string& text) {
    const std::size_t plus = text.rfind('+');
    const std::string before = plus == std::string::npos ? "" : text.substr(0, plus);
    return {key_code(plus == std::string::npos ? text : text.substr(plus + 1)),
            before.find("shift") != std::string::npos, before.find("ctrl") != std::string::npos, false};
}

class Window {
public:
    ~Window() {
        if (has_imgui_) {
            ImGui_ImplOpenGL3_Shutdown();
            ImGui_ImplGlfw_Shutdown();
            ImGui::DestroyContext();
        }
        if (hidden_) glfwDestroyWindow(hidden_);
        if (window_) glfwDestroyWindow(window_);
        if (has_glfw_) glfwTerminate();
    }
    Window() = default;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    Status open(const Setup& setup) {
        has_glfw_ = glfwInit() == GLFW_TRUE;
        if (!has_glfw_) return no_window("no display");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
        const std::string title =
            setup.run.source.path.empty() ? "petzval" : setup.run.source.path + " - petzval";
        window_ = glfwCreateWindow(setup.width, setup.height, title.c_str(), nullptr, nullptr);
        if (!window_) return no_window("no OpenGL 3.2");
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        glfwSetKeyCallback(window_, on_key);  // ImGui's calls it as well
        glfwSetWindowRefreshCallback(window_, on_expose);
        glfwSetDropCallback(window_, on_drop);
        start_imgui(setup.scale);
        return Done{};
    }
    GLFWwindow* get() const { return window_; }
    // A context of its own for another thread; null where there is none.
    GlContext second_context() {
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        hidden_ = glfwCreateWindow(1, 1, "petzval sprites", nullptr, nullptr);
        if (!hidden_) return nullptr;
        return [hidden = hidden_](bool current) { glfwMakeContextCurrent(current ? hidden : nullptr); };
    }

private:
    static Status no_window(const std::string& why) {
        return Error{ErrorCode::Unsupported, "no window can be opened: " + why + glfw_says()};
    }
    void start_imgui(double scale) {
        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui::StyleColorsDark();
        float across = 1, down = 1;
        glfwGetWindowContentScale(window_, &across, &down);
        const float size = float(scale > 0 ? scale : double(std::clamp(across, 0.5f, 8.0f)));
        ImGui::GetStyle().ScaleAllSizes(size);
        ImGui::GetStyle().WindowRounding = 0;
        ImGui::GetStyle().Colors[ImGuiCol_PopupBg].w = 1;
        ImGui::GetStyle().Colors[ImGuiCol_SliderGrab].w = 0.45f;  // the number stands on it
        load_letters(size);
        ImGui_ImplGlfw_InitForOpenGL(window_, true);
        ImGui_ImplOpenGL3_Init("#version 150");
        has_imgui_ = true;
    }
    static void load_letters(float scale) {
        const char* file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
        static const ImWchar letters[]{0x20, 0xFF, 0x2010, 0x2026, 0};
        std::error_code ignored;
        if (std::filesystem::exists(file, ignored))
            ImGui::GetIO().Fonts->AddFontFromFileTTF(file, std::round(14 * scale), nullptr, letters);
        else
            ImGui::GetIO().FontGlobalScale = scale;
        const char* bold = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";  // of changed values
        if (std::filesystem::exists(file, ignored) && std::filesystem::exists(bold, ignored))
            ImGui::GetIO().Fonts->AddFontFromFileTTF(bold, std::round(14 * scale), nullptr, letters);
    }

    GLFWwindow *window_ = nullptr, *hidden_ = nullptr;
    bool has_glfw_ = false, has_imgui_ = false;
};

// A script's events replace those of the mouse.
void move_hand(GLFWwindow* window, const Hand& hand) {
    ImGuiIO& io = ImGui::GetIO();
    if (hand.resize) glfwSetWindowSize(window, hand.resize->first, hand.resize->second);
    io.MousePos = {float(hand.x), float(hand.y)};
    io.MouseDown[0] = hand.button;
    io.MouseDown[1] = hand.right;
    io.MouseWheel = float(hand.wheel);
    if (!hand.key.empty()) pressed_keys().push_back(key_press(hand.key));
}

void take_keys(App& app) {
    std::vector<KeyPress> keys;
    keys.swap(pressed_keys());
    if (ImGui::GetIO().WantTextInput) return;
    for (const KeyPress& key : keys)
        for (const Binding& binding : bindings()) {
            const KeyPress bound = key_press(binding.key);
            const bool repeats = binding.line.find("_by") != std::string::npos;
            if (bound.code == key.code && bound.shift == key.shift && bound.ctrl == key.ctrl &&
                (repeats || !key.repeated))
                static_cast<void>(act(app, binding.line));
        }
}

void draw(App& app) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    const float panel = app.state.panels ? std::min(26 * letter, 0.6f * size.x) : 0;
    const float status = std::min(3.4f * letter, 0.5f * size.y);
    constexpr auto flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
    const auto place = [](float x, float y, float width, float height) {
        ImGui::SetNextWindowPos({x, y});
        ImGui::SetNextWindowSize({std::max(1.0f, width), std::max(1.0f, height)});
    };
    const float lens = app.state.lens ? 0.45f * size.y : 0;
    const float frames =
        app.state.timeline.is_shot() ? std::min((app.is_live() ? 12.0f : 10.5f) * letter, 0.35f * size.y) : 0;
    place(0, 0, size.x - panel, size.y - status - lens - frames);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::Begin("picture", nullptr, flags | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar(2);
    draw_canvas(app);
    ImGui::End();
    app.widgets.clear();
    if (app.state.lens) {
        place(0, size.y - status - lens - frames, size.x - panel, lens);
        ImGui::Begin("lens", nullptr, flags);
        draw_lens(app);
        ImGui::End();
    }
    if (app.state.timeline.is_shot()) {
        place(0, size.y - status - frames, size.x - panel, frames);
        ImGui::Begin("shot", nullptr, flags);
        draw_timeline(app);
        ImGui::End();
    }
    place(0, size.y - status, size.x - panel, status);
    ImGui::Begin("status", nullptr, flags);
    draw_status_line(app);
    ImGui::End();
    app.screen_height = double(size.y);
    if (app.state.panels) {
        place(size.x - panel, 0, panel, size.y);
        ImGui::Begin("panels", nullptr, (flags & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_MenuBar);
        draw_menu(app);
        draw_panels(app);
        ImGui::End();
    }
    if (app.has_sheet()) draw_sheet(app);
    if (app.state.help) draw_help(app);
    if (app.state.opening) draw_open(app);
}

class Loop {
public:
    Loop(GLFWwindow* window, const Setup& setup, std::optional<Script> script)
        : window_(window), app_(setup, [] { glfwPostEmptyEvent(); }), script_(std::move(script)) {}

    Status operator()() {
        while (!glfwWindowShouldClose(window_) && !app_.quit) {
            tick();
            if (app_.unopened) return *app_.unopened;
            if (!script_) continue;
            report_error();
            if (script_->failure()) return *script_->failure();
            if (script_->is_done()) break;
        }
        app_.finish_saving();
        if (script_) report_error();
        if (script_)
            std::fprintf(
                stderr,
                "petzval: longest tick %.1f ms, longest cancel %.1f ms, longest from a change to its "
                "first picture %.1f ms\n",
                app_.slowest.tick, app_.slowest.cancel, app_.slowest.first_picture);
        glfwHideWindow(window_);  // a device may still be preparing its programs
        return Done{};
    }

private:
    // Nobody reads the status line of a window that a script drives.
    void report_error() {
        if (app_.error == reported_) return;
        reported_ = app_.error;
        if (!reported_.empty()) std::fprintf(stderr, "petzval: %s\n", reported_.c_str());
    }
    // Sleeps until something happens; a few ticks follow it, as widgets answer one late.
    void wait_for_events() {
        if (lively_ticks_ > 0 || script_)
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(0.5);
        lively_ticks_ = std::max(lively_ticks_ - 1, 0);
        const ImGuiIO& io = ImGui::GetIO();
        if (app_.is_busy() || app_.state.timeline.playing || io.MouseDown[0] || io.MouseDelta.x != 0 ||
            io.MouseDelta.y != 0)
            lively_ticks_ = 6;
    }

    void tick() {
        wait_for_events();
        const auto start = Clock::now();
        app_.take_news();
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        if (script_) move_hand(window_, script_->tick(app_));
        ImGui::NewFrame();
        take_keys(app_);
        if (!dropped_file().empty())
            static_cast<void>(act(app_, "open \"" + std::exchange(dropped_file(), "") + "\""));
        draw(app_);
        if (!ImGui::IsAnyItemActive()) app_.settle_choice();
        app_.ask();
        name_window();
        if (!app_.copied.empty() && app_.copied != clipboard_)
            glfwSetClipboardString(window_, (clipboard_ = app_.copied).c_str());
        ImGui::Render();
        const double worked = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (++ticks_ > 3) app_.slowest.tick = std::max(app_.slowest.tick, worked);  // the first load shaders
        // Skips unchanged frames: drawing the window on a CPU would take half of the pictures' time.
        const std::uint64_t print = fingerprint(*ImGui::GetDrawData());
        const bool is_asked = is_exposed() || (script_ && script_->looks_at_screen());
        if (is_asked || print != painted_) paint();
        painted_ = print, is_exposed() = false;
        std::this_thread::sleep_until(start + kFrame);  // where swapping does not wait for the display
    }

    // The title follows the file that is open.
    void name_window() {
        const std::string& path = app_.state.choice.input.path;
        if (path == named_) return;
        named_ = path;
        glfwSetWindowTitle(window_, (path.empty() ? "petzval" : path + " - petzval").c_str());
    }

    void paint() {
        int width = 1, height = 1;
        glfwGetFramebufferSize(window_, &width, &height);
        glViewport(0, 0, width, height);
        glClearColor(0.08f, 0.08f, 0.08f, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        if (script_ && script_->looks_at_screen())
            script_->seen(app_, {width, height, pixels_on_screen(width, height)});
        glfwSwapBuffers(window_);
    }

    GLFWwindow* window_;
    App app_;
    std::optional<Script> script_;
    std::string clipboard_, reported_, named_;
    int lively_ticks_ = 10, ticks_ = 0;
    std::uint64_t painted_ = 0;
};

}  // namespace

Status run(const Setup& setup) {
    std::optional<Script> script;
    if (!setup.script.empty()) {
        auto read = Script::read(setup.script);
        if (!read) return read.error();
        script = std::move(*read);
    }
    Setup complete = setup;
    if (Status ready = prepare(complete); !ready) return ready;
    Window window;
    if (Status open = window.open(setup); !open) return open;
    if (setup.scene == "hexadrive") complete.gl_context = window.second_context();
    return Loop(window.get(), complete, std::move(script))();
}

}  // namespace petzval::view
