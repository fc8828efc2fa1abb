// Linked to programs under a sanitizer: the leaks of a library that is unloaded have no name to suppress them
// by.
extern "C" int dlclose(void*) noexcept { return 0; }
