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
    // How it is enlarged: as squares, at first, or smoothly.
    void enlarge_smoothly(bool smoothly) const;
    // So many have been loaded, all together: what was drawn before one was is out of date.
    static std::uint64_t loads();
    bool empty() const { return name_ == 0; }
    unsigned name() const { return name_; }

private:
    unsigned name_ = 0;
    mutable bool is_smooth_ = false;
};

// What is drawn, lower left corner first, as PNG keeps it: rows from the top, three bytes a pixel.
std::vector<std::uint16_t> pixels_on_screen(int width, int height);

}  // namespace petzval::view
