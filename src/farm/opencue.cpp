// A job specification of OpenCue, by its DTD cjsl-1.15.
#include "petzval/frames.h"

#include "farm/writers.h"

#include <algorithm>
#include <cstdlib>

namespace petzval::farm {
namespace {

constexpr const char* kDoctype = R"(<?xml version="1.0"?>
<!DOCTYPE spec PUBLIC "SPI Cue Specification Language"
    "http://localhost:8080/spcue/dtd/cjsl-1.15.dtd">
)";

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? std::string("&lt;") : std::string(1, c);
    return out;
}

std::string element(const std::string& name, const std::string& text) {
    return "<" + name + ">" + escaped(text) + "</" + name + ">";
}

// $SHOW and so on, as cuecmd takes them.
std::string variable(const char* name, const std::string& otherwise) {
    const char* value = std::getenv(name);
    return value && *value ? value : otherwise;
}

std::string layer(const FarmShot& shot) {
    std::string text = "<layer name=\"defocus\" type=\"Render\">\n";
    const auto add = [&](const char* name, const std::string& value) {
        text += "          " + element(name, value) + "\n";
    };
    add("cmd", shell_word(shot.folder + "/run.sh") + " #FRAMESPEC#");
    add("range", frames_text(shot.frames));
    add("chunk", std::to_string(shot.chunk));
    add("cores", std::to_string(std::max(shot.threads, 1)));
    add("threadable", "1");
    if (shot.memory_bytes > 0) add("memory", std::to_string(memory_mib(shot)) + "m");
    return text + "        </layer>\n";
}

}  // namespace

Result<FarmFile> opencue_file(const FarmShot& shot) {
    std::string text = kDoctype;
    text += "<spec>\n  " + element("show", variable("SHOW", "petzval")) + "\n  " +
            element("shot", variable("SHOT", shot.name)) + "\n  " +
            element("user", variable("USER", "unknown")) + "\n";
    text +=
        "  <job name=\"" + shot.name + "\">\n    " + element("maxretries", "1") + "\n    <layers>\n      ";
    text += layer(shot) + "    </layers>\n  </job>\n</spec>\n";
    return FarmFile{"petzval.xml", text};
}

}  // namespace petzval::farm
