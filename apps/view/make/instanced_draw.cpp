#define GL_GLEXT_PROTOTYPES
#include "instanced_draw.h"

#include "instanced_shaders.h"

#include <GL/gl.h>
#include <GL/glext.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace petzval::view {
namespace {

constexpr int kBorder = 12;    // texels around a level; sprites of its rim reach into them
constexpr int kWidest_px = 8;  // radius of the widest sprite, in texels of its level

Error unsupported(const std::string& why) { return {ErrorCode::Unsupported, "sprites of 2009: " + why}; }

// Texels of a level's side.
int texels(int pixels, int level) { return (pixels + (1 << level) - 1) >> level; }

// Mirrors corner_of() of the programs.
struct Atlas {
    int width = 0, height = 0, levels = 1;  // of the picture

    int all_width() const { return 2 * (width + 2 * kBorder * levels); }
    int all_height() const { return height + texels(height, 1) + 4 * kBorder; }
    Rect area_of(int level, bool near) const {
        int x = (near ? all_width() / 2 : 0) + kBorder, y = kBorder;
        if (level > 0) y += height + 2 * kBorder;
        for (int l = 1; l < level; ++l) x += texels(width, l) + 2 * kBorder;
        return {x, y, x + texels(width, level), y + texels(height, level)};
    }
    std::vector<Panel> panels() const {
        std::vector<Panel> all;
        for (const bool near : {false, true})
            for (int level = 0; level < levels; ++level) {
                const Rect area = area_of(level, near);
                all.push_back({(near ? "NEAR " : "FAR ") + std::to_string(level), area, {}});
            }
        return all;
    }
};

// Names of OpenGL objects, deleted at the end. Requires: the context is current until then.
class Objects {
public:
    ~Objects() {
        for (const GLuint name : textures_) glDeleteTextures(1, &name);
        for (const GLuint name : programs_) glDeleteProgram(name);
        glDeleteFramebuffers(1, &frame_);
        glDeleteVertexArrays(1, &vertices_);
    }
    Objects() {
        glGenFramebuffers(1, &frame_);
        glGenVertexArrays(1, &vertices_);
        glBindFramebuffer(GL_FRAMEBUFFER, frame_);
        glBindVertexArray(vertices_);
    }
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;

    GLuint texture(int width, int height, GLint format, GLenum channels, const void* data, GLint filter) {
        GLuint name = 0;
        glGenTextures(1, &name);
        textures_.push_back(name);
        glBindTexture(GL_TEXTURE_2D, name);
        for (const GLenum setting : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            glTexParameteri(GL_TEXTURE_2D, setting, filter);
        for (const GLenum setting : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
            glTexParameteri(GL_TEXTURE_2D, setting, GL_CLAMP_TO_EDGE);
        glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, channels, GL_FLOAT, data);
        return name;
    }
    Result<GLuint> program(const char* vertex, const char* fragment) {
        const GLuint name = glCreateProgram();
        programs_.push_back(name);
        for (const auto& [kind, text] :
             {std::pair(GL_VERTEX_SHADER, vertex), {GL_FRAGMENT_SHADER, fragment}}) {
            const GLuint shader = glCreateShader(GLenum(kind));
            const std::array parts{kInstancedShared, text};
            glShaderSource(shader, 2, parts.data(), nullptr);
            glCompileShader(shader);
            glAttachShader(name, shader);
            glDeleteShader(shader);
        }
        glLinkProgram(name);
        GLint linked = 0;
        glGetProgramiv(name, GL_LINK_STATUS, &linked);
        if (linked == GL_TRUE) return name;
        std::array<char, 512> log{};
        glGetProgramInfoLog(name, GLsizei(log.size()), nullptr, log.data());
        return unsupported(std::string("the driver refuses the program: ") + log.data());
    }

private:
    GLuint frame_ = 0, vertices_ = 0;
    std::vector<GLuint> textures_, programs_;
};

void set_lens(GLuint program, const SpriteLens& lens, const Atlas& atlas, int every) {
    const auto at = [&](const char* name) { return glGetUniformLocation(program, name); };
    glUseProgram(program);
    glUniform2i(at("size"), atlas.width, atlas.height);
    glUniform1i(at("every"), every);
    glUniform1i(at("levels"), atlas.levels);
    glUniform1i(at("colours"), 0);
    glUniform1i(at("radii"), 1);
    glUniform1i(at("atlas"), 2);
    const int blades = lens.aperture.blades;
    glUniform1i(at("blades"), blades);
    glUniform1f(at("turn"), float(-lens.aperture.rotation_deg * 3.14159265 / 180));
    glUniform1f(at("area"),
                blades > 2 ? float(0.5 * blades * std::sin(2 * 3.14159265 / blades)) : 3.14159265f);
    const Camera& camera = lens.camera;
    const double pupil_mm = 0.5 * camera.focal_length_mm / camera.f_number;
    const double corner = 0.5 * camera.sensor_width_mm * std::hypot(1.0, double(atlas.height) / atlas.width) /
                          camera.focal_length_mm;
    std::array<float, 8> rims{};
    const std::size_t count = std::min<std::size_t>(lens.barrel.size(), 4);
    for (std::size_t i = 0; i < count; ++i) {
        rims[2 * i] = float(lens.barrel[i].distance_mm * corner / pupil_mm);
        rims[2 * i + 1] = float(lens.barrel[i].radius_mm / pupil_mm);
    }
    glUniform1i(at("rim_count"), int(count));
    glUniform2fv(at("rims"), 4, rims.data());
}

bool draws_into(GLuint texture, int width, int height) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glViewport(0, 0, width, height);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

Picture read_back(int width, int height) {
    Picture picture = Picture::uninitialised(width, height);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, picture.pixels());
    return picture;
}

// Runs the pass and waits for its end.
template <typename Pass>
StageTime timed(const std::string& name, const Pass& pass) {
    const auto start = std::chrono::steady_clock::now();
    pass();
    glFinish();
    return {name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

Result<InstancedDraw> drawn(const Picture& colour, const Plane& radii_px, const SpriteLens& lens, int every,
                            const Atlas& atlas) {
    Objects objects;
    const auto sprites = objects.program(kInstancedVertex, kInstancedFragment);
    if (!sprites) return sprites.error();
    const auto composite = objects.program(kCompositeVertex, kCompositeFragment);
    if (!composite) return composite.error();
    const int width = atlas.width, height = atlas.height;
    const GLuint levels =
        objects.texture(atlas.all_width(), atlas.all_height(), GL_RGBA32F, GL_RGBA, nullptr, GL_LINEAR);
    const GLuint result = objects.texture(width, height, GL_RGBA32F, GL_RGBA, nullptr, GL_NEAREST);
    glActiveTexture(GL_TEXTURE0);
    objects.texture(width, height, GL_RGBA32F, GL_RGBA, colour.pixels(), GL_NEAREST);
    glActiveTexture(GL_TEXTURE1);
    objects.texture(width, height, GL_R32F, GL_RED, radii_px.pixels(), GL_NEAREST);
    if (!draws_into(levels, atlas.all_width(), atlas.all_height()))
        return unsupported("the driver does not draw floats");
    InstancedDraw made;
    const int count =
        texels(width, 0) == 0 ? 0 : ((width + every - 1) / every) * ((height + every - 1) / every);
    set_lens(*sprites, lens, atlas, every);
    made.stages.push_back(timed(std::to_string(count) + " sprites in one draw", [&] {
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
        glDisable(GL_BLEND);
    }));
    made.atlas = read_back(atlas.all_width(), atlas.all_height());
    for (std::size_t i = 0; i < made.atlas.size(); ++i) made.atlas.pixels()[i].a = 1;
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, levels);
    if (!draws_into(result, width, height)) return unsupported("the driver does not draw floats");
    set_lens(*composite, lens, atlas, every);
    made.stages.push_back(timed("levels over the picture", [] { glDrawArrays(GL_TRIANGLE_STRIP, 0, 4); }));
    made.image = read_back(width, height);
    made.panels = atlas.panels();
    made.device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));  // NOLINT: OpenGL says it in bytes
    return made;
}

}  // namespace

Result<InstancedDraw> draw_instanced(const GlContext& context, const Picture& colour, const Plane& radii_px,
                                     const SpriteLens& lens, int every) {
    float widest = 1;
    for (std::size_t i = 0; i < radii_px.size(); ++i) {
        const float radius = std::abs(radii_px.pixels()[i]);
        if (std::isfinite(radius)) widest = std::max(widest, radius);
    }
    const int levels = 1 + std::max(0, int(std::ceil(std::log2(widest / kWidest_px))));
    const Atlas atlas{colour.width(), colour.height(), levels};
    context(true);
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    auto made = atlas.all_width() > most || atlas.all_height() > most
                    ? Result<InstancedDraw>(unsupported("the atlas is too large for the driver"))
                    : drawn(colour, radii_px, lens, every, atlas);
    context(false);
    return made;
}

}  // namespace petzval::view
