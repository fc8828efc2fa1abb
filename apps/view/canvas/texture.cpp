#include "texture.h"

#include <GLFW/glfw3.h>

#ifndef GL_CLAMP_TO_EDGE
#define GL_CLAMP_TO_EDGE 0x812F
#endif

namespace petzval::view {
namespace {

std::uint64_t all_loads = 0;  // of the window's thread alone

}  // namespace

std::uint64_t Texture::loads() { return all_loads; }

void Texture::enlarge_smoothly(bool smoothly) const {
    if (name_ == 0 || smoothly == is_smooth_) return;
    is_smooth_ = smoothly;
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, smoothly ? GL_LINEAR : GL_NEAREST);
    ++all_loads;
}

Texture::~Texture() {
    if (name_ != 0) glDeleteTextures(1, &name_);
}

void Texture::load(int width, int height, const std::vector<std::uint8_t>& rgba) {
    // A new one: the old may still be drawn from, and loading it would wait for that.
    if (name_ != 0) glDeleteTextures(1, &name_);
    glGenTextures(1, &name_);
    ++all_loads;
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, is_smooth_ ? GL_LINEAR : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

std::vector<std::uint16_t> pixels_on_screen(int width, int height) {
    std::vector<std::uint8_t> rows(3 * std::size_t(width) * std::size_t(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rows.data());
    std::vector<std::uint16_t> upright(rows.size());
    const std::size_t row = 3 * std::size_t(width);
    for (std::size_t y = 0; y < std::size_t(height); ++y)
        for (std::size_t i = 0; i < row; ++i)
            upright[y * row + i] = rows[(std::size_t(height) - 1 - y) * row + i];
    return upright;
}

}  // namespace petzval::view
