// The host, as the plug-in sees it: its suites, and its properties with an answer for every question.
#pragma once

#include "ofx.h"
#include "ofx_names.h"

#include <string>
#include <vector>

namespace petzval::plugin {

// The suites of the host; null where it has none.
struct Suites {
    const ofx::PropertySuite* property = nullptr;
    const ofx::ImageEffectSuite* effect = nullptr;
    const ofx::ParameterSuite* parameter = nullptr;
    const ofx::MessageSuite* message = nullptr;
    bool persistent_messages = false;
    const ofx::DrawSuite* draw = nullptr;
    const ofx::InteractSuite* interact = nullptr;
};
const Suites& suites();

void set_host(const ofx::Host* host);
// The name that the host gives itself. Requires: fetch_suites() was true.
std::string host_name();
// Fetches all suites. False if one of the first three, which no effect can do without, is missing.
bool fetch_suites();

// A set of properties. Getters give the fallback where the host does not have the property, or no set at all;
// setters of properties that a host does not know do nothing.
class Properties {
public:
    explicit Properties(ofx::PropertySet* set) : set_(set) {}

    ofx::PropertySet* handle() const { return set_; }
    int integer(const char* name, int fallback = 0, int index = 0) const;
    double number(const char* name, double fallback = 0, int index = 0) const;
    void* pointer(const char* name) const;
    std::string text(const char* name) const;
    ofx::Point point(const char* name, ofx::Point fallback) const;
    bool rect(const char* name, ofx::RectI& rect) const;

    Properties& set(const char* name, int value, int index = 0);
    Properties& set(const char* name, double value, int index = 0);
    Properties& set(const char* name, const char* value, int index = 0);
    Properties& set(const char* name, void* value);
    Properties& set(const char* name, const ofx::Rect& rect);

private:
    ofx::PropertySet* set_;
};

Properties properties_of(ofx::Effect* effect);

// The message that the user sees on the effect, until it is cleared.
void show_error(ofx::Effect* effect, const std::string& sentence);
void show_warning(ofx::Effect* effect, const std::string& sentence);
void clear_message(ofx::Effect* effect);

}  // namespace petzval::plugin
