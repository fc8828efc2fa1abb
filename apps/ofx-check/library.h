// A plug-in's bundle on disk, and its library in memory.
#pragma once

#include "ofx.h"

#include <string>
#include <vector>

namespace ofx_check {

struct Bundle {
    std::string library;  // the .ofx; empty where there is none
    std::string problem;  // what its layout lacks; empty if nothing
};
// Takes the folder of a bundle, or the path of an .ofx.
Bundle find_bundle(const std::string& path);

// Names that the library exports, in order. Empty where it cannot be read.
std::vector<std::string> exported_names(const std::string& library);

class Library {
public:
    // `problem` says why it could not be loaded.
    Library(const std::string& path, std::string& problem);
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    bool is_loaded() const { return handle_ != nullptr; }
    // Calls OfxSetHost, where it is exported, and OfxGetNumberOfPlugins.
    int plugin_count() const;
    ofx::Plugin* plugin(int nth) const;

private:
    template <typename Function>
    Function* function(const char* name) const;
    void* handle_;
};

}  // namespace ofx_check
