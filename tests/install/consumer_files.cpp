#include <cstdio>
#include <petzval/files.h>

int main() {
    const auto frame = petzval::read_frame("no such file.exr", {});
    return !frame && std::puts(frame.error().message.c_str()) >= 0 ? 0 : 1;
}
