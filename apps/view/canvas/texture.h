// Codes on the graphics card.
#pragma once

#include <cstdint>
#include <vector>

namespace petzval::view {

// Needs the window's OpenGL context wherever it is used, its end included.
class Texture {
public:
    Texture() = default;
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    // Rows from the top, four bytes a pixel.
    void load(int width, int height, const std::vector<std::uint8_t>& rgba);
    // Enlargement: squares (default) or smooth.
    void enlarge_smoothly(bool smoothly) const;
    // Number of loads of all textures: anything drawn before the last load is out of date.
    static std::uint64_t loads();
    bool empty() const { return name_ == 0; }
    unsigned name() const { return name_; }

private:
    unsigned name_ = 0;
    mutable bool is_smooth_ = false;
};

// The drawn pixels, in PNG's order: rows from the top, three bytes per pixel.
std::vector<std::uint16_t> pixels_on_screen(int width, int height);

}  // namespace petzval::view
