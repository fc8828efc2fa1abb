// Linked to programs under a sanitizer: the leaks of a library that is unloaded have no name to suppress them
// by. Visible, because libraries must find it before the one of the C library.
extern "C" __attribute__((visibility("default"))) int dlclose(void*) noexcept { return 0; }
