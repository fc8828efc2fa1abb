#include <cstdio>
#include <petzval/ocio.h>

int main() {
    const auto codes = petzval::ocio_codes(petzval::Picture(2, 2), {"no such display", "", ""});
    return !codes && std::puts(codes.error().message.c_str()) >= 0 ? 0 : 1;
}
